// Places of a run's files: names that tell the scene and the date, and folders that are nobody else's.
#pragma once

#include <string>

namespace mpm_ros {

/// The bag to write. `name`: as given, below `folder` when it is relative; `run` > 1 (after resets) is added before the
/// ending, since a bag holds one run. "auto" stands for mpm_<scene>_<date and time>.bag in the folder, with a number
/// behind it when that is there. An empty folder is the working folder.
std::string bag_path(const std::string& name, const std::string& scene, int run, const std::string& folder = {});

/// Makes BASE/<scene>_<date and time>, with a number behind it when that is there, and returns its path.
/// @throws mpm::Error when it cannot be made
std::string make_run_folder(const std::string& base, const std::string& scene);

/// The path from the root; as it is given where the working folder was removed.
std::string absolute_path(const std::string& path);

}  // namespace mpm_ros
