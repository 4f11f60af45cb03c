#include "mpm_ros/command/joint_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/math/nanoseconds.hpp"
#include "mpm/math/nearest.hpp"
#include "mpm_ros/message/bag_error.hpp"
#include "mpm_ros/message/conversions.hpp"

namespace mpm_ros {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

const char* field_of(mpm::JointDrive drive) { return mpm::kJointDriveNames[static_cast<std::size_t>(drive)]; }

/// The first value that is not finite, in words.
std::string problem_in(const std::vector<double>& values, const char* what) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) return fmt::format("{}[{}] is {}", what, i, values[i]);
  }
  return {};
}

/// Drive of a joint; none where the robot has no such joint, or it cannot be commanded.
std::optional<mpm::JointDrive> drive_of(const mpm::RobotDefinition& definition, const std::string& joint) {
  for (const mpm::JointDefinition& one : definition.joints) {
    if (definition.model.joints[one.joint].name == joint) return one.drive;
  }
  return std::nullopt;
}

std::string no_joint(const mpm::RobotDefinition& definition, const std::string& joint) {
  std::vector<std::string> names;
  for (const mpm::JointDefinition& one : definition.joints) names.push_back(definition.model.joints[one.joint].name);
  return fmt::format("no joint '{}' can be commanded; {}", joint, mpm::suggest(joint, names));
}

}  // namespace

JointOrder read_order(const sensor_msgs::JointState& message, int robot, const mpm::RobotDefinition& definition,
                      std::string& problem) {
  JointOrder order;
  order.robot = robot;
  order.joints = message.name;
  order.requested = message.header.stamp;
  if (message.name.empty()) problem = "it names no joint";
  for (std::size_t j = 0; j < message.name.size() && problem.empty(); ++j) {
    const auto drive = drive_of(definition, message.name[j]);
    if (!drive) {
      problem = no_joint(definition, message.name[j]);
      break;
    }
    const std::vector<double>& values = *drive == mpm::JointDrive::velocity   ? message.velocity
                                        : *drive == mpm::JointDrive::position ? message.position
                                                                              : message.effort;
    if (values.size() != message.name.size()) {
      problem = fmt::format("{} names, and {} values in {}, which the drive of '{}' follows", message.name.size(),
                            values.size(), field_of(*drive), message.name[j]);
    } else {
      order.values.push_back(values[j]);
      if (!std::isfinite(values[j])) problem = fmt::format("{}[{}] is {}", field_of(*drive), j, values[j]);
    }
  }
  return order;
}

JointOrder read_order(const trajectory_msgs::JointTrajectory& message, int robot, std::string& problem) {
  JointOrder order;
  order.robot = robot;
  order.joints = message.joint_names;
  order.requested = message.header.stamp;
  const std::size_t count = message.joint_names.size();
  if (count == 0) problem = "it names no joint";
  if (message.points.empty()) problem = "it has no points";
  const bool rates = !message.points.empty() && !message.points.front().velocities.empty();
  for (std::size_t p = 0; p < message.points.size() && problem.empty(); ++p) {
    const trajectory_msgs::JointTrajectoryPoint& point = message.points[p];
    if (point.positions.size() != count) {
      problem = fmt::format("point {} has {} positions for {} joints", p, point.positions.size(), count);
    } else if (rates ? point.velocities.size() != count : !point.velocities.empty()) {
      problem = fmt::format("point {} has {} velocities for {} joints; give them at every point or at none", p,
                            point.velocities.size(), count);
    }
    order.times.push_back(point.time_from_start.toSec());
    order.values.insert(order.values.end(), point.positions.begin(), point.positions.end());
    order.velocities.insert(order.velocities.end(), point.velocities.begin(), point.velocities.end());
  }
  if (problem.empty()) problem = problem_in(order.values, "positions");
  if (problem.empty()) problem = problem_in(order.velocities, "velocities");
  return order;
}

JointOrder read_order(const mpm_ros::JointCommand& message, int robot, std::string& problem) {
  JointOrder order;
  order.robot = robot;
  order.joints = message.joints;
  order.values = message.values;
  order.velocities = message.velocities;
  order.times = message.times;
  order.requested = message.requested;
  order.effect = message.effect_ns;
  order.arrival = message.arrival_ns;
  const std::size_t wanted = message.joints.size() * std::max<std::size_t>(1, message.times.size());
  if (message.joints.empty()) {
    problem = "it names no joint";
  } else if (message.values.size() != wanted) {
    problem = fmt::format("{} values for {} joints and {} times; {} are needed", message.values.size(),
                          message.joints.size(), message.times.size(), wanted);
  } else if (!message.velocities.empty() && (message.times.empty() || message.velocities.size() != wanted)) {
    problem = fmt::format("{} velocities; a trajectory has none, or as many as values", message.velocities.size());
  }
  if (problem.empty()) problem = problem_in(order.values, "values");
  if (problem.empty()) problem = problem_in(order.velocities, "velocities");
  if (problem.empty()) problem = problem_in(order.times, "times");
  return order;
}

JointOrder apply(JointOrder order, mpm::Simulation& simulation) {
  order.effect = simulation.time();
  const double start = mpm::seconds_of(order.stamp.value_or(order.effect));
  for (double& time : order.times) time += start;
  apply_again(order, simulation);
  return order;
}

void apply_again(const JointOrder& order, mpm::Simulation& simulation) {
  std::vector<int> joints;
  for (const std::string& name : order.joints) joints.push_back(simulation.find_joint(order.robot, name));
  if (order.times.empty()) {
    simulation.command_joints(order.robot, joints, order.values, order.arrival);
    return;
  }
  std::vector<std::vector<mpm::JointKnot>> knots(joints.size());
  for (std::size_t p = 0, at = 0; p < order.times.size(); ++p) {
    for (std::size_t j = 0; j < joints.size(); ++j, ++at) {
      knots[j].push_back(
          {order.times[p], order.values.at(at), order.velocities.empty() ? kNone : order.velocities.at(at)});
    }
  }
  simulation.follow_trajectory(order.robot, joints, std::move(knots));
}

mpm_ros::JointCommand to_message(const JointOrder& order, const std::string& robot, const Stamps& stamps) {
  mpm_ros::JointCommand message;
  message.header.stamp = stamps.at(order.effect);
  message.robot = robot;
  message.joints = order.joints;
  message.values = order.values;
  message.velocities = order.velocities;
  message.times = order.times;
  message.requested = order.requested;
  message.effect_ns = order.effect;
  message.arrival_ns = order.arrival;
  return message;
}

JointOrder from_message(const mpm_ros::JointCommand& message, const mpm::Simulation& simulation) {
  const int robot = simulation.find_robot(message.robot);
  if (robot < 0) {
    throw BagError(
        fmt::format("a recorded command is for the robot '{}', which the scene does not have", message.robot));
  }
  std::string problem;
  JointOrder order = read_order(message, robot, problem);
  if (!problem.empty()) throw BagError(fmt::format("a recorded command for '{}': {}", message.robot, problem));
  return order;
}

}  // namespace mpm_ros
