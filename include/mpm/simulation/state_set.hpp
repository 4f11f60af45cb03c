// State of a rigid body or a robot that is set between two steps, in place of what the run has come to.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mpm/rigid/motion.hpp"

namespace mpm {

/// The definition of what is set; see Simulation::set_state().
struct StateSet {
  std::string name;          ///< name of a rigid body or of a robot
  std::optional<Pose> pose;  ///< pose of the body, or of the robot's base; with its twist. None: both stay
  Twist twist;               ///< twist of that origin, world axes; of a free body or a free base alone
  std::vector<std::string> joints;
  std::vector<double> positions;   ///< one for each of these joints [m], [rad]
  std::vector<double> velocities;  ///< the same; empty: at rest [m/s], [rad/s]
};

}  // namespace mpm
