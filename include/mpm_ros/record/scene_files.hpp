// The files that a scene names beside its own text, with a hash of each: a recording says by it whether a mesh or
// a map of heights is still the one that it was made with.
//
// Weak: of files that those name in turn (the meshes in a robot's description) no hash is kept.
#pragma once

#include <mpm_ros/SceneFile.h>

#include <string>
#include <vector>

namespace mpm_ros {

/// Every text under `bodies`, `rigid_bodies` and `cracks` that names a file which is there, by a path from the scene's
/// folder or in a package. `text`: the scene's, YAML. `scene_path`: where it was read.
std::vector<SceneFile> scene_files(const std::string& text, const std::string& scene_path);

/// Paths of those files, and the meshes that a robot's description among them names.
std::vector<std::string> files_read_by(const std::string& text, const std::string& scene_path);

/// Fate of recorded files, a line for each that is gone or has changed.
std::vector<std::string> changed_files(const std::vector<SceneFile>& recorded, const std::string& scene_path);

}  // namespace mpm_ros
