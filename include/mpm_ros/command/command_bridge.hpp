// From command topics to the queue: checks each message, turns its frame into the world's (or names the body in whose
// axes it stands), refuses what cannot be used with a reason and without any effect.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <mpm_ros/Command.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "mpm/simulation/report.hpp"
#include "mpm_ros/command/command_queue.hpp"
#include "mpm_ros/message/node_health.hpp"
#include "mpm_ros/message/stamps.hpp"

namespace mpm_ros {

class CommandBridge {
 public:
  /// Subscribes at once, on the node handle's callback queue. `queue` and `health` must outlive it.
  CommandBridge(ros::NodeHandle node, const std::vector<std::string>& bodies, const std::string& world_frame,
                CommandQueue& queue, NodeHealth& health);

  /// The run began (again): what stamps mean from now on.
  void set_stamps(const Stamps& stamps);

  /// A command of a step request, checked as those on topics are. `problem` says why not; then the result is of no use.
  BodyCommand read(const mpm_ros::Command& message, std::string& problem) const;

  /// Asks the master for command topics of bodies that the scene does not have, and refuses each once.
  void find_strangers();

 private:
  void on_twist(int body, const geometry_msgs::Twist& message);
  void on_twist_stamped(int body, const geometry_msgs::TwistStamped& message);
  void on_pose(int body, const geometry_msgs::PoseStamped& message);
  void read_twist(const geometry_msgs::Twist& twist, const std::string& frame, const ros::Time& stamp,
                  BodyCommand& command, std::string& problem) const;
  void read_pose(const geometry_msgs::Pose& pose, const std::string& frame, const ros::Time& stamp,
                 BodyCommand& command, std::string& problem) const;
  void set_stamp(const ros::Time& stamp, BodyCommand& command, std::string& problem) const;
  void push_or_refuse(const std::string& topic, BodyCommand command, const std::string& problem);
  /// Pose of a frame in the world, or the body whose frame it is.
  mpm::Pose find_frame(const std::string& frame, const ros::Time& stamp, int& body, std::string& problem) const;
  int find_body(const std::string& name) const;

  const std::vector<std::string> bodies_;
  const std::string world_frame_;
  const std::string prefix_;  // of body topics, resolved
  CommandQueue& queue_;
  NodeHealth& health_;
  mutable std::mutex mutex_;  // of stamps_
  Stamps stamps_;
  tf2_ros::Buffer frames_;
  tf2_ros::TransformListener listener_;
  std::vector<ros::Subscriber> subscribers_;
  std::set<std::string> strangers_;
};

/// A due command in world axes; `bodies` as they are at its effect [ns].
AppliedCommand in_world(const DueCommand& due, const std::vector<mpm::BodyState>& bodies, std::int64_t effect);

}  // namespace mpm_ros
