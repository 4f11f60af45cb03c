#include "mpm_ros/node/frame_poses.hpp"

#include <fmt/format.h>
#include <ros/callback_queue.h>
#include <ros/console.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm/simulation/projected.hpp"
#include "mpm_ros/command/frame_follower.hpp"
#include "mpm_ros/message/topics.hpp"
#include "mpm_ros/node/sim_clock.hpp"
#include "mpm_ros/report/report_bag.hpp"
#include "mpm_ros/run/stop_signals.hpp"

namespace mpm_ros {

namespace {

/// The scene of a recorded run, YAML; empty where it says none. @throws BagError
std::string recorded_scene(const std::string& bag_path) {
  const RunBag bag(bag_path, {});
  return bag.info() ? bag.info()->scene_text : std::string();
}

/// tf, heard on a queue of its own, since nothing else spins yet.
class TfEar {
 public:
  explicit TfEar(ros::NodeHandle node) {
    node.setCallbackQueue(&queue_);
    for (const bool fixed : {false, true}) {
      subscribers_[fixed ? 1 : 0] = node.subscribe<tf2_msgs::TFMessage>(
          fixed ? topics::kTfStatic : topics::kTf, 1000,
          [this, fixed](const tf2_msgs::TFMessage::ConstPtr& message) { hear(*message, fixed); });
    }
  }
  const tf2::BufferCore& listen(double seconds) {
    queue_.callAvailable(ros::WallDuration(seconds));
    return frames_;
  }

 private:
  void hear(const tf2_msgs::TFMessage& message, bool fixed) {
    for (const geometry_msgs::TransformStamped& transform : message.transforms) {
      try {
        frames_.setTransform(transform, "tf", fixed);
      } catch (const std::runtime_error&) {
        // Is refused, with a line, when the run listens.
      }
    }
  }

  ros::CallbackQueue queue_;
  tf2::BufferCore frames_;
  ros::Subscriber subscribers_[2];
};

}  // namespace

FramePoses::FramePoses(const ros::NodeHandle& node, const NodeParameters& parameters,
                       const std::vector<std::string>& set)
    : starts_(frame_starts(parameters.scene, set)) {
  if (starts_.empty()) return;
  const mpm::Scene scene = mpm::load_scene(parameters.scene, set);
  const std::vector<std::string> names = mpm::commanded_names(scene);
  for (const FrameStart& start : starts_) {
    const auto found = std::find(names.begin(), names.end(), start.body);
    bodies_.push_back(found == names.end() ? 0 : static_cast<int>(found - names.begin()));
  }
  set_.resize(starts_.size());
  if (!parameters.resume.empty()) {
    take_recorded(mpm::read_checkpoint(parameters.resume).label.scene_text);
    return;
  }
  if (!parameters.commands.empty()) {
    take_recorded(recorded_scene(parameters.commands));
    return;
  }

  SimClock clock(node, parameters.publish_clock, 0.0);
  clock.publish(0, Stamps(), true);
  TfEar ear(node);
  constexpr double kLook = 0.05;   // [s] between looks
  constexpr double kAgain = 10.0;  // [s] until it is said again, with the reason
  const std::string& world = parameters.world_frame;
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    const std::string& frame = scene.commands[static_cast<std::size_t>(bodies_[i])].frame;
    ROS_INFO_STREAM(
        fmt::format("waits for the tf frame '{}' in '{}', where '{}' begins, before it starts (drive: tf; a "
                    "body that has a pose in the scene begins there)",
                    frame, world, starts_[i].body));
    std::fflush(stdout);  // a pipe would keep it meanwhile
    ros::WallTime said = ros::WallTime::now();
    for (;;) {
      std::string problem;
      if (const auto pose = frame_pose(ear.listen(kLook), world, frame, problem)) {
        put(i, scene, bodies_[i], *pose);
        break;
      }
      if (stop_requested() || !ros::ok())
        throw mpm::StoppedError(fmt::format("stopped while waiting for the tf frame '{}'", frame));
      if (ros::WallTime::now() < said + ros::WallDuration(kAgain)) continue;
      said = ros::WallTime::now();
      ROS_WARN_STREAM(fmt::format("still waits for the tf frame '{}': {}", frame, problem));
    }
  }
}

void FramePoses::put(std::size_t start, const mpm::Scene& scene, int body, const mpm::Pose& pose) {
  const mpm::GeometryKind geometry = scene.definition.geometry;
  const auto& bodies = scene.definition.rigid_bodies;
  const auto index = static_cast<std::size_t>(body);
  try {
    // Robots are of solid scenes, where every pose is one of the geometry.
    set_[start] = pose_override(starts_[start],
                                index < bodies.size() ? mpm::projected(pose, geometry, bodies[index]) : pose, geometry);
  } catch (const mpm::RigidError& error) {
    throw ParameterError(fmt::format("'{}' cannot begin at its tf frame '{}': {}", starts_[start].body,
                                     scene.commands[static_cast<std::size_t>(body)].frame, error.what()));
  }
}

void FramePoses::take_recorded(const std::string& scene_text) {
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    try {
      set_[i] = recorded_pose(starts_[i], scene_text);
    } catch (const YAML::Exception&) {
      set_[i].clear();
    }
  }
}

}  // namespace mpm_ros
