// Velocities that hold in the axes of the bodies themselves: as such a body turns, so does its velocity in the world.
// At each sync point at which the body stands otherwise than at the one before it is commanded anew, in world axes,
// which is what is recorded. Weak: within a sync period the direction is that of the period's start.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "mpm/definition/report.hpp"
#include "mpm/math/state_archive.hpp"
#include "mpm_ros/command/body_command.hpp"

namespace mpm_ros {

class TurningTwists {
 public:
  /// The body moves from now on by `twist` in its own axes; `orientation`: its present one, by which that was applied.
  void hold(int body, const mpm::Twist& twist, const mpm::Quat& orientation);
  /// Another command moves the body.
  void drop(int body) { held_.erase(body); }
  /// Commands that are to be applied at the sync point `now` [ns], where bodies have turned.
  std::vector<AppliedCommand> next(const std::vector<mpm::BodyState>& bodies, std::int64_t now);
  /// For checkpoints.
  void serialise(mpm::StateArchive& archive);

 private:
  struct Held {
    mpm::Twist twist;       ///< body axes
    mpm::Quat orientation;  ///< orientation of the body when it was applied last
  };
  std::map<int, Held> held_;
};

}  // namespace mpm_ros
