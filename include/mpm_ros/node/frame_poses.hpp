// First poses of rigid bodies that follow a tf frame and have no pose in their scene: where the frame is, for which the
// node waits; in a run that goes on from a checkpoint, or repeats recorded commands, where the recorded run began.
#pragma once

#include <ros/node_handle.h>

#include <optional>
#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "mpm_ros/node/frame_start.hpp"
#include "mpm_ros/node/node_parameters.hpp"

namespace mpm_ros {

/// The poses as changes to the scene.
class FramePoses {
 public:
  FramePoses() = default;
  /// Waits for the frames of the scene with the changes `set`, without a limit, and says so. Publishes meanwhile /clock
  /// at its start, where the node is to publish it. @throws mpm::Error; ParameterError or BagError: a recording that is
  /// to be repeated cannot be read; mpm::StoppedError: a stop was asked for first
  FramePoses(const ros::NodeHandle& node, const NodeParameters& parameters, const std::vector<std::string>& set);

  /// True if there are such bodies.
  bool any() const { return !starts_.empty(); }
  const std::vector<std::string>& set() const { return set_; }
  /// For the next run of that scene: the poses of those frames that `look` knows (by the body's index); the others
  /// stay.
  template <typename Look>
  void look_again(const mpm::Scene& scene, Look look);
  /// Those that the text of a recorded run has; a body without one there begins where its scene has it, as that run
  /// did.
  void take_recorded(const std::string& scene_text);

 private:
  void put(std::size_t start, const mpm::Scene& scene, int body, const mpm::Pose& pose);

  std::vector<FrameStart> starts_;
  std::vector<int> bodies_;       ///< body of the scene, for each start
  std::vector<std::string> set_;  ///< setting of each start's pose; empty without one
};

template <typename Look>
void FramePoses::look_again(const mpm::Scene& scene, Look look) {
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    if (const std::optional<mpm::Pose> pose = look(bodies_[i])) put(i, scene, bodies_[i], *pose);
  }
}

}  // namespace mpm_ros
