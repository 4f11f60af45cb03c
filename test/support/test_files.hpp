// Paths of the files that tests read.
#pragma once

#include <string>

#include "mpm/math/build_info.hpp"

/// Path of a file of the package, from its path relative to the package, without a leading slash.
inline std::string source_file(const std::string& path) { return mpm::source_folder() + "/" + path; }
/// Path of the file of this name in test/data.
inline std::string data_file(const std::string& name) { return source_file("test/data/" + name); }
