// Rigid bodies that follow a tf frame and have no pose in their scene: they begin where their frame is. The pose
// becomes an override (as of --set), with which the scene is loaded, so the scene's text, which recordings and
// checkpoints keep, has it.
#pragma once

#include <string>
#include <vector>

#include "mpm/math/geometry_kind.hpp"
#include "mpm/rigid/motion.hpp"

namespace mpm_ros {

struct FrameStart {
  std::string body;  ///< its name, or its number where it has none
  std::string path;  ///< "rigid_bodies.tool0.pose"
};

/// The bodies, then the bases of robots, with `drive` and without `pose`. Arguments as of mpm::load_scene(). @throws
/// mpm::SceneError: the scene cannot be read
std::vector<FrameStart> frame_starts(const std::string& name_or_path, const std::vector<std::string>& overrides);

/// The override that lets the body begin at a pose, which is one of the geometry.
std::string pose_override(const FrameStart& start, const mpm::Pose& pose, mpm::GeometryKind geometry);

/// The same for the pose that the text of a recorded run has; empty where it has none.
std::string recorded_pose(const FrameStart& start, const std::string& scene_text);

}  // namespace mpm_ros
