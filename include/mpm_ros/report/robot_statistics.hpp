// Robots over a run, gathered message by message: ranges and peaks of joints, peaks of sensors, energies at both ends.
#pragma once

#include <mpm_ros/RobotState.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "mpm_ros/report/extreme.hpp"

namespace mpm_ros {

/// A number over the run.
struct NumberRange {
  double first = 0.0, last = 0.0;
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  double largest = 0.0;   ///< the value of the largest magnitude
  std::int64_t time = 0;  ///< time of it [ns]

  void take(double value, std::int64_t when, bool begins);
};

struct JointStatistics {
  std::string name;
  bool prismatic = false;
  std::uint8_t drive = RobotState::EFFORT;
  NumberRange position, velocity, effort;
};

struct SensorStatistics {
  std::string joint, link;
  Extreme force, torque;
};

struct RobotStatistics {
  std::vector<JointStatistics> joints;
  std::vector<SensorStatistics> sensors;
  RobotState first, last;

  const std::string& name() const { return last.name; }
  /// `time` [ns]. The joints and sensors are those of the first message.
  void take(std::int64_t time, const RobotState& robot);
};

}  // namespace mpm_ros
