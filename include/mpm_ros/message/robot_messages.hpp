// Robots as messages: all that a run tells of them, and the joints as robot_state_publisher takes them.
#pragma once

#include <mpm_ros/RobotState.h>
#include <sensor_msgs/JointState.h>

#include <string>
#include <vector>

#include "mpm/robot/robot_report.hpp"

namespace mpm_ros {

/// A robot at the end of an interval; `start`: at its begin. Efforts of drives and wrenches of sensors are means over
/// the interval, so that over any time they sum up to the impulse that was applied. Where it is 0 [s] long they are
/// those of the last step.
RobotState to_message(const mpm::RobotReport& now, const mpm::RobotReport& start, double interval);
/// The same of each of several.
std::vector<RobotState> to_message(const std::vector<mpm::RobotReport>& now, const std::vector<mpm::RobotReport>& start,
                                   double interval);

/// Positions, velocities and efforts, without a header.
sensor_msgs::JointState joint_state_of(const RobotState& robot);

/// Reason why a message from elsewhere cannot be read, or empty: a list that is not as long as that of joints.
std::string problem_of(const RobotState& robot);

/// "m" or "rad", and those of the joint's velocity and effort.
struct JointUnits {
  std::string position, velocity, effort;
  /// Unit of a target, by the constant of RobotState that says what the drive follows.
  const std::string& target(std::uint8_t drive) const;
};
const JointUnits& joint_units(bool prismatic);

}  // namespace mpm_ros
