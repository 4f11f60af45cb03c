// The names of files that a run reads and writes, told to mpm::FilesInUse, so that no output costs an input or another
// output.
#pragma once

#include <string>

#include "mpm/math/files_in_use.hpp"

namespace mpm_ros {

/// The files of the tables and snapshots that --csv writes into a folder, and of --vtk: regular expressions.
inline constexpr const char* kCsvFiles =
    "(contact_forces|contact_pairs|bodies|solver_state|global_quantities|crack_tips|crack_points|joints|robots|"
    "commands|"
    "particles|particles_[0-9]+|terrain|terrain_[0-9]+)\\.csv|outline_.*\\.obj";
inline constexpr const char* kVtkFiles = "run\\.pvd|(particles|body_.*|cracks)_[0-9]+(_[0-9]+)?\\.p?vtp";

/// A recording, with its parts. `what`: as the user knows it.
void reads_bag(const std::string& what, const std::string& bag, mpm::FilesInUse& files);
/// A bag that is to be recorded; parts that it has, or may get, go with it. @throws mpm::FileInUse
void writes_bag(const std::string& option, const std::string& bag, mpm::FilesInUse& files);

}  // namespace mpm_ros
