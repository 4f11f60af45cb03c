// A name under which a file is to be written.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

namespace mpm {

/// Reason why no file can be made under that name, or replaced: a folder, a device, a pipe or a socket is there, which
/// writing would replace, or block on. Empty for a regular file or a new one.
std::string refused_output(const std::string& path);

/// The file that a name stands for: from the root, links followed, also one to a file that is not there yet. Two names
/// for one file have the same, unless it has two directory entries (hard links).
std::string behind_links(const std::string& path);

/// The inode number of a file, by which machines that share a disk know it; 0 if there is none of this name.
std::uint64_t inode_of(const std::string& path);

/// Opens a file to be written, replacing what it held. Returns why that cannot be done, and what to do; empty if it
/// was.
std::string open_output(std::ofstream& file, const std::string& path);

}  // namespace mpm
