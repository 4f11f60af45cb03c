// Maps of heights that a scene takes from topics.
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <utility>
#include <vector>

namespace mpm_ros {

/// Result of the maps for a scene.
struct HeightMaps {
  std::vector<std::string> set;                           ///< overrides of the scene, after those that it had
  std::vector<std::pair<std::string, std::string>> from;  ///< bodies, and the topics as resolved
};

/// Waits for one message on each topic from which the scene takes heights (mpm/terrain/height_topic.hpp); returns at
/// once when there is none. `set`: overrides of the scene.
/// @throws mpm::Error: the scene, or a message that makes no map. @throws mpm::StoppedError: a stop was asked for first
HeightMaps wait_for_height_maps(const ros::NodeHandle& node, const std::string& scene,
                                const std::vector<std::string>& set, const std::string& world_frame);

}  // namespace mpm_ros
