// Files that a run reads and writes, so that no output costs the scene, a file of it, a recording or
// another output.
#pragma once

#include <string>

#include "mpm/math/files_in_use.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm_ros/message/files_of_run.hpp"
#include "mpm_ros/run/run_scene.hpp"

namespace mpm_ros {

/// The scene, and every file that it names.
void reads_scene(const mpm::Scene& scene, mpm::FilesInUse& files);
/// A checkpoint may be saved to the file that the run was resumed from, which is replaced when the new one is whole.
/// @throws mpm::FileInUse where an output of run_scene would overwrite what the run reads, or another output
void check_outputs(const RunSceneOptions& options, const mpm::Scene& scene);

}  // namespace mpm_ros
