#include "mpm_ros/report/robot_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "mpm_ros/message/conversions.hpp"

namespace mpm_ros {

void NumberRange::take(double value, std::int64_t when, bool begins) {
  if (begins) first = value;
  last = value;
  least = std::min(least, value);
  most = std::max(most, value);
  if (std::abs(value) <= std::abs(largest)) return;
  largest = value;
  time = when;
}

void RobotStatistics::take(std::int64_t time, const RobotState& robot) {
  const bool begins = last.name.empty();
  if (begins) {
    first = robot;
    for (std::size_t j = 0; j < robot.joints.size(); ++j)
      joints.push_back({robot.joints[j], robot.prismatic[j] != 0, robot.drive[j], {}, {}, {}});
    for (const JointWrench& sensor : robot.sensors) sensors.push_back({sensor.joint, sensor.link, {}, {}});
  }
  last = robot;
  for (std::size_t j = 0; j < std::min(joints.size(), robot.joints.size()); ++j) {
    joints[j].position.take(robot.position[j], time, begins);
    joints[j].velocity.take(robot.velocity[j], time, begins);
    joints[j].effort.take(robot.effort[j], time, begins);
  }
  for (std::size_t s = 0; s < std::min(sensors.size(), robot.sensors.size()); ++s) {
    sensors[s].force.offer(from_message(robot.sensors[s].wrench.force), time);
    sensors[s].torque.offer(from_message(robot.sensors[s].wrench.torque), time);
  }
}

}  // namespace mpm_ros
