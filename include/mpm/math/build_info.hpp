// Facts that only the build knows: the version, and where the package's files lie. One source file is compiled with
// these facts, so that no other object depends on them.
#pragma once

#include <string>

namespace mpm {

/// The package's version, "0.1.0".
std::string build_version();
/// The package's folder of sources, absolute, without a slash at its end.
std::string source_folder();
/// Folder where an installation has launch/ and config/, absolute, without a slash at its end.
std::string installed_folder();

}  // namespace mpm
