// Commands to rigid bodies: as they are asked for, and as they are applied.
#pragma once

#include <mpm_ros/Command.h>
#include <ros/time.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mpm/rigid/motion.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm_ros/message/stamps.hpp"

namespace mpm_ros {

enum class CommandKind : std::uint8_t {
  velocity = mpm_ros::Command::VELOCITY,
  pose = mpm_ros::Command::POSE,
  wrench = mpm_ros::Command::WRENCH
};

/// A checked command that waits for its time.
struct BodyCommand {
  int body = 0;  ///< index in the simulation
  CommandKind kind = CommandKind::velocity;
  mpm::Twist twist;     ///< velocity: of the body's origin
  mpm::Wrench wrench;   ///< wrench: on a free body
  mpm::Pose pose;       ///< pose: to be at
  int frame_body = -1;  ///< rigid body in whose axes it is given, as they are when it is applied; -1: world
  ros::Time requested;  ///< stamp it came with
  std::optional<std::int64_t> stamp;  ///< the same in simulated time [ns]; none: as soon as possible
  bool late = false;                  ///< the stamp was zero, or past when it came
  std::string sender;                 ///< node that published it, for an order that is not that of arrival
  std::uint64_t order = 0;            ///< order of arrival
};

/// A command as the simulation gets it; world axes.
struct AppliedCommand {
  int body = 0;
  CommandKind kind = CommandKind::velocity;
  mpm::Twist twist;
  mpm::Wrench wrench;
  mpm::Pose pose;
  std::int64_t effect = 0;   ///< [ns] simulated time at which it takes effect
  std::int64_t arrival = 0;  ///< [ns] pose: when it is reached
  ros::Time requested;
  bool stamp_ignored = false;     ///< it has a stamp, `requested`, which was not used
  std::optional<mpm::Twist> own;  ///< velocity that was given in the axes of the body itself: in these
};

/// Gives the command to the simulation, whose time() is the command's effect. @throws mpm::RigidError, then nothing is
/// changed: not finite, a pose that is none, or a motion of more than the domain's diagonal in a sync period, which no
/// tool means and which would take steps without end; so too a wrench that makes a body so fast within one.
void apply(const AppliedCommand& command, mpm::Simulation& simulation);

/// The commands that stop a body: zero for its prescribed velocities, and no wrench if it is free.
std::vector<AppliedCommand> stop_commands(int body, const mpm::Simulation& simulation);
/// The check of apply() for a motion that no tool means. @throws mpm::RigidError
void check_travel(const AppliedCommand& command, const mpm::Simulation& simulation);
/// A pose that its body reaches only by more than a cell in a sync period is more of a jump than a motion: that, in
/// words. Empty for others.
std::string jump_of(const AppliedCommand& command, const mpm::Simulation& simulation);

/// As recorded and published.
mpm_ros::Command to_message(const AppliedCommand& command, const std::string& body, const std::string& world_frame,
                            const Stamps& stamps);
/// The exact inverse but for the body's name. @throws BagError when the scene has no such body or the kind is unknown.
AppliedCommand from_message(const mpm_ros::Command& message, const mpm::Simulation& simulation);

}  // namespace mpm_ros
