// Hears the topics that command joints of robots, and hands what they ask for to the queue. What cannot be used is
// refused with the reason, and changes nothing.
#pragma once

#include <ros/ros.h>

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "mpm/robot/definition.hpp"
#include "mpm_ros/command/joint_queue.hpp"
#include "mpm_ros/message/node_health.hpp"

namespace mpm_ros {

class JointBridge {
 public:
  /// Subscribes at once, on the node handle's callback queue. `queue` and `health` must outlive it. `latest`: stamps of
  /// messages are not used. `heard`: called after each message, one that is refused too.
  JointBridge(ros::NodeHandle node, std::vector<mpm::RobotDefinition> robots, JointQueue& queue, NodeHealth& health,
              bool latest, std::function<void()> heard);

  /// The run began (again), with these robots, which have the same names: what stamps mean from now on.
  void begin(const std::vector<mpm::RobotDefinition>& robots, const Stamps& stamps);

  /// A message for a robot. Any thread.
  void take(int robot, const sensor_msgs::JointState& message);
  void take(int robot, const trajectory_msgs::JointTrajectory& message);
  /// An order of a step request. `problem` says why it cannot be used.
  JointOrder read(const mpm_ros::JointCommand& message, std::string& problem) const;

 private:
  template <typename Message>
  void subscribe(ros::NodeHandle& node, int robot, const char* leaf);
  void set_stamp(JointOrder& order) const;
  void push_or_refuse(const char* leaf, JointOrder order, const std::string& problem);

  JointQueue& queue_;
  NodeHealth& health_;
  const bool latest_;
  const std::function<void()> heard_;
  mutable std::mutex mutex_;  // mutex of what follows
  std::vector<mpm::RobotDefinition> robots_;
  Stamps stamps_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace mpm_ros
