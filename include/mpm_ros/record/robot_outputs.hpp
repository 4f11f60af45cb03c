// Messages of robots: joints as robot_state_publisher takes them, wrenches of sensors at joints.
#pragma once

#include <geometry_msgs/Wrench.h>
#include <sensor_msgs/JointState.h>

#include <string>
#include <vector>

#include "mpm/definition/report.hpp"
#include "mpm/math/state_archive.hpp"
#include "mpm/robot/robot_report.hpp"

namespace mpm_ros {

/// A joint with its child's wrench, in the child's axes: its frame is that link.
struct SensorMessage {
  std::string topic, frame;
  geometry_msgs::Wrench wrench;
};

class RobotOutputs {
 public:
  /// A robot's joints, without a header. Efforts of drives are means since the last call of take(), so that over any
  /// time they sum up to the impulse that was applied.
  static sensor_msgs::JointState joints(const mpm::RobotReport& now, const mpm::RobotReport& last, double interval);
  static std::vector<SensorMessage> sensors(const mpm::RobotReport& now, const mpm::RobotReport& last, double interval);
  /// Places of the base links, for tf: from there on robot_state_publisher has the links. A base that is called as the
  /// world's frame is left out.
  static std::vector<mpm::BodyState> bases(const std::vector<mpm::RobotDefinition>& robots,
                                           const std::vector<mpm::RobotReport>& now, const std::string& world_frame);

  /// Reports of now and of the last call, and the time between [s].
  struct Interval {
    std::vector<mpm::RobotReport> now, last;
    double length = 0.0;
  };
  Interval take(std::vector<mpm::RobotReport> now, double time);
  void serialise(mpm::StateArchive& archive);

 private:
  std::vector<mpm::RobotReport> last_;
  double time_ = 0.0;  // [s]
};

}  // namespace mpm_ros
