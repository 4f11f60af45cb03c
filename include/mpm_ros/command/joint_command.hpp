// Commands to joints of robots: as they are asked for, and as they are applied.
#pragma once

#include <mpm_ros/JointCommand.h>
#include <ros/time.h>
#include <sensor_msgs/JointState.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mpm/simulation/simulation.hpp"
#include "mpm_ros/message/stamps.hpp"

namespace mpm_ros {

struct JointOrder {
  int robot = 0;
  std::vector<std::string> joints;
  std::vector<double> values;  ///< as JointCommand.msg has them, as those below
  std::vector<double> velocities;
  std::vector<double> times;  ///< [s] simulated; before it is applied from its start on
  std::int64_t effect = 0;    ///< [ns] simulated
  std::int64_t arrival = 0;   ///< [ns] simulated
  ros::Time requested;
  std::optional<std::int64_t> stamp;  ///< time of its start [ns]; none: as soon as possible
  std::uint64_t order = 0;            ///< order of arrival
};

/// The parts of messages that say what is asked for. `problem` says why they cannot be used: lengths, numbers that are
/// not finite. Each joint's value is that of its drive. @throws mpm::RigidError for a joint that is not there
JointOrder read_order(const sensor_msgs::JointState& message, int robot, const mpm::RobotDefinition& definition,
                      std::string& problem);
JointOrder read_order(const trajectory_msgs::JointTrajectory& message, int robot, std::string& problem);
JointOrder read_order(const mpm_ros::JointCommand& message, int robot, std::string& problem);

/// Gives the order to the simulation, whose time() is its effect; its times count from there on if it has no stamp.
/// @return the order as it was applied. @throws mpm::RigidError, then nothing is changed
JointOrder apply(JointOrder order, mpm::Simulation& simulation);
/// The same for one that was recorded as it was applied.
void apply_again(const JointOrder& order, mpm::Simulation& simulation);

/// As recorded and published.
mpm_ros::JointCommand to_message(const JointOrder& order, const std::string& robot, const Stamps& stamps);
/// The inverse. @throws BagError when the scene has no such robot
JointOrder from_message(const mpm_ros::JointCommand& message, const mpm::Simulation& simulation);

}  // namespace mpm_ros
