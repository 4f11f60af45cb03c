// A file that somebody names to be read.
#pragma once

#include <fstream>
#include <string>

namespace mpm {

/// Reason why nothing can be read under that name, to follow "PATH: ": there is no file, or a folder, or a device, a
/// pipe or a socket, which may have no end or keep its reader waiting; or it may not be read. Empty for a regular file
/// that can be.
std::string refused_input(const std::string& path);

/// Opens a file to be read. Returns why that cannot be done; empty if it was.
std::string open_input(std::ifstream& file, const std::string& path);

/// Reads all of a file. Returns why that cannot be done; empty if it was.
std::string read_input(const std::string& path, std::string& bytes);

}  // namespace mpm
