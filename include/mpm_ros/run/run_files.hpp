// What of a run's files is read and what is written, so that no output costs the scene, a file of it, a recording or
// another output.
#pragma once

#include <string>

#include "mpm/math/files_in_use.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm_ros/run/run_scene.hpp"

namespace mpm_ros {

/// The files of the tables and snapshots that --csv writes into a folder, and of --vtk: regular expressions.
inline constexpr const char* kCsvFiles =
    "(contact_forces|contact_pairs|bodies|solver_state|global_quantities|crack_tips|crack_points|commands|"
    "particles|particles_[0-9]+)\\.csv|outline_.*\\.obj";
inline constexpr const char* kVtkFiles = "run\\.pvd|(particles|body_.*|cracks)_[0-9]+(_[0-9]+)?\\.p?vtp";

/// The scene, and every file that it names.
void reads_scene(const mpm::Scene& scene, mpm::FilesInUse& files);
/// A recording, with its parts. `what`: as the user knows it.
void reads_bag(const std::string& what, const std::string& bag, mpm::FilesInUse& files);
/// A bag that is to be recorded; parts that it has, or may get, go with it. @throws mpm::FileInUse
void writes_bag(const std::string& option, const std::string& bag, mpm::FilesInUse& files);

/// A checkpoint may be saved to the file that the run was resumed from, which is replaced when the new one is whole.
/// @throws mpm::FileInUse where an output of run_scene would overwrite what the run reads, or another output
void check_outputs(const RunSceneOptions& options, const mpm::Scene& scene);

}  // namespace mpm_ros
