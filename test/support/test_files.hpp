// Where files that tests read lie.
#pragma once

#include <string>

#include "mpm/math/build_info.hpp"

/// A file of the package by its path below the package's folder, without a slash before it.
inline std::string source_file(const std::string& path) { return mpm::source_folder() + "/" + path; }
/// A file in test/data by its name.
inline std::string data_file(const std::string& name) { return source_file("test/data/" + name); }
