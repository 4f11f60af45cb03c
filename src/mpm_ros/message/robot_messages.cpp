#include "mpm_ros/message/robot_messages.hpp"

#include <fmt/format.h>

#include <utility>

#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/quantities.hpp"

namespace mpm_ros {

namespace {

/// Mean of what `total` counts since the start, over an interval; without a length that of the last step.
template <class Value>
Value mean_of(const Value& total, const Value& before, double interval, const Value& last_step) {
  if (!(interval > 0.0)) return last_step;
  return (total - before) / interval;
}

}  // namespace

RobotState to_message(const mpm::RobotReport& now, const mpm::RobotReport& start, double interval) {
  RobotState state;
  state.name = now.name;
  state.base = to_message(now.base);
  state.base_twist = to_message(now.base_twist);
  for (std::size_t j = 0; j < now.joints.size(); ++j) {
    const mpm::JointReport& joint = now.joints[j];
    state.joints.push_back(joint.name);
    state.prismatic.push_back(joint.prismatic ? 1 : 0);
    state.position.push_back(joint.position);
    state.velocity.push_back(joint.velocity);
    state.effort.push_back(mean_of(joint.impulse, start.joints[j].impulse, interval, joint.effort));
    state.target.push_back(joint.target);
    state.drive.push_back(static_cast<std::uint8_t>(joint.drive));
  }
  for (std::size_t s = 0; s < now.sensors.size(); ++s) {
    const mpm::SensorReport& sensor = now.sensors[s];
    const mpm::Wrench& before = start.sensors[s].impulse;
    mpm::Wrench mean;
    mean.force = mean_of<mpm::Vec3>(sensor.impulse.force, before.force, interval, sensor.wrench.force);
    mean.torque = mean_of<mpm::Vec3>(sensor.impulse.torque, before.torque, interval, sensor.wrench.torque);
    JointWrench& wrench = state.sensors.emplace_back();
    wrench.joint = sensor.joint;
    wrench.link = sensor.link;
    wrench.wrench = to_message(mean);
  }
  fill(state, now, robot_quantities());
  return state;
}

std::vector<RobotState> to_message(const std::vector<mpm::RobotReport>& now, const std::vector<mpm::RobotReport>& start,
                                   double interval) {
  std::vector<RobotState> states;
  for (std::size_t r = 0; r < now.size(); ++r) states.push_back(to_message(now[r], start[r], interval));
  return states;
}

sensor_msgs::JointState joint_state_of(const RobotState& robot) {
  sensor_msgs::JointState message;
  message.name = robot.joints;
  message.position = robot.position;
  message.velocity = robot.velocity;
  message.effort = robot.effort;
  return message;
}

std::string problem_of(const RobotState& robot) {
  const std::size_t joints = robot.joints.size();
  for (const auto& [what, size] : {std::pair("prismatic", robot.prismatic.size()),
                                   {"position", robot.position.size()},
                                   {"velocity", robot.velocity.size()},
                                   {"effort", robot.effort.size()},
                                   {"target", robot.target.size()},
                                   {"drive", robot.drive.size()}}) {
    if (size != joints) return fmt::format("'{}' has {} joints and {} values of {}", robot.name, joints, size, what);
  }
  return {};
}

const std::string& JointUnits::target(std::uint8_t drive) const {
  return drive == RobotState::POSITION ? position : drive == RobotState::VELOCITY ? velocity : effort;
}

const JointUnits& joint_units(bool prismatic) {
  static const JointUnits slides{"m", "m/s", "N"}, turns{"rad", "rad/s", "N m"};
  return prismatic ? slides : turns;
}

}  // namespace mpm_ros
