// How a rigid body moves as far as a scene tells: by its functions of time, at rest where commands are to move it.
#pragma once

#include "mpm/scene/scene.hpp"

namespace mpm {

struct ToolMotion {
  double fastest = 0.0;  ///< highest speed of its surface [m/s]
  double along = 0.0;    ///< way of its origin along gravity, to and fro [m]
  double across = 0.0;   ///< the same across gravity [m]
  bool is_told = false;  ///< whether a function moves or turns it
  bool turns = false;    ///< whether one turns it
};

/// Over the run; over 10 s of one without an end. What functions do not tell at a time is left out: who moves the body
/// says so.
ToolMotion tool_motion(const RigidBodyDefinition& body, const SimulationDefinition& definition);

}  // namespace mpm
