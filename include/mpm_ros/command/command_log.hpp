// The commands that a bag recorded, applied again at the simulated time at which they took effect: with the same scene
// this gives the same state hash.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mpm/simulation/simulation.hpp"
#include "mpm_ros/command/body_command.hpp"
#include "mpm_ros/command/joint_command.hpp"
#include "mpm_ros/command/set_state.hpp"

namespace mpm_ros {

class CommandLog {
 public:
  CommandLog() = default;
  /// In the order in which they were applied; effect_ns must not decrease. @throws BagError
  explicit CommandLog(std::vector<mpm_ros::Command> commands, std::vector<mpm_ros::JointCommand> joints = {},
                      std::vector<mpm_ros::StateSet> states = {});

  bool empty() const { return commands_.empty() && joints_.empty() && states_.empty(); }
  std::size_t size() const { return commands_.size() + joints_.size() + states_.size(); }
  /// Commands whose time has come at simulation.time() and that were not taken before.
  /// @throws BagError for a body that the simulation does not have, or an effect between two sync points.
  std::vector<AppliedCommand> take(const mpm::Simulation& simulation);
  /// The same of commands to joints, which were applied after those.
  std::vector<JointOrder> take_joints(const mpm::Simulation& simulation);
  /// The same of states that were set, which came before those.
  std::vector<mpm::StateSet> take_states(const mpm::Simulation& simulation);
  /// Goes on with what takes effect at `time` [ns] or later: what was before is in a checkpoint.
  void skip_to(std::int64_t time);

 private:
  std::vector<mpm_ros::Command> commands_;
  std::vector<mpm_ros::JointCommand> joints_;
  std::vector<mpm_ros::StateSet> states_;
  std::size_t next_ = 0, next_joint_ = 0, next_state_ = 0;
};

/// The commands in a bag and in the parts after it, in order. @throws BagError when it cannot be read or has no topic
/// of type mpm_ros/Command.
CommandLog read_commands(const std::string& bag_path);

}  // namespace mpm_ros
