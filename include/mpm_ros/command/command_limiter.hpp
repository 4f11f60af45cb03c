// Keeps commands within what a body may do: speed, rotation rate, and how fast either changes.
//
// A limited body is moved from sync point to sync point by commands of the limiter's own, which are recorded as
// applied: a bag replays without the limiter. A velocity is approached by a ramp at the acceleration limit. A pose is
// approached in a straight line, turning about one axis, no faster than allowed and than it has to be to arrive in
// time, and so that the body can come to rest there: it does not overshoot, and arrives late if it must. A body whose
// speed does not allow that (it was commanded to turn back) goes beyond, and returns.
//
// Weak: a stream of poses is followed behind by the distance that braking takes, v^2 / (2 a); position and orientation
// of a late pose do not arrive together. Twists are constant between sync points, so accelerations are mean values over
// a sync period. What a scene's functions of time do is not limited.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "mpm/math/state_archive.hpp"
#include "mpm/rigid/motion_limits.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm_ros/command/body_command.hpp"
#include "mpm_ros/message/node_health.hpp"

namespace mpm_ros {

/// The largest speed [m/s, rad/s] from which a body that loses `acceleration` * `period` [m/s^2, rad/s^2, s] at the end
/// of each period comes to rest after `distance` [m, rad] exactly. Infinite acceleration: distance / period.
double braking_speed(double distance, double acceleration, double period);

class CommandLimiter {
 public:
  /// `limits`: of each rigid body. `health` hears what was limited, and must outlive the limiter.
  CommandLimiter(std::vector<mpm::MotionLimits> limits, NodeHealth& health);

  /// True when the command's body has limits: it is its goal from now on, in place of the one before. False: nothing
  /// was done. @throws mpm::RigidError for a velocity that apply() would refuse within its limits too
  bool take(const AppliedCommand& command, const mpm::Simulation& simulation);
  /// Commands of the bodies that are under way to a goal, in the sync period to come.
  std::vector<AppliedCommand> next(const mpm::Simulation& simulation);
  /// The body is on its way no longer.
  void drop(int body);
  /// Goes on with what `other` is on the way to, within its limits.
  void take_over(const CommandLimiter& other);

  void serialise(mpm::StateArchive& archive);
  /// Goals of bodies under way.
  std::vector<AppliedCommand> goals() const;

 private:
  struct Goal {
    AppliedCommand command;
    bool limited = false;  // already counted
  };
  /// Command for the next period; `reached`: the goal is met with it.
  AppliedCommand towards_velocity(Goal& goal, const mpm::RigidBody& body, const mpm::Simulation& simulation,
                                  bool& reached);
  AppliedCommand towards_pose(Goal& goal, const mpm::RigidBody& body, const mpm::Simulation& simulation, bool& reached);
  void count(Goal& goal);

  std::vector<mpm::MotionLimits> limits_;
  NodeHealth& health_;
  std::map<int, Goal> goals_;          // by body
  std::map<int, LimitHealth> report_;  // by body
};

}  // namespace mpm_ros
