// A name under which a file is to be written.
#pragma once

#include <string>

namespace mpm {

/// Why no file can be made under that name, or replaced: a folder, a device, a pipe or a socket is there, which writing
/// would replace, or block on. Empty for a regular file or a new one.
std::string refused_output(const std::string& path);

}  // namespace mpm
