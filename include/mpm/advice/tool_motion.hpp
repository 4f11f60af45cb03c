// Motion of a rigid body as far as a scene tells: by its functions of time, at rest where commands are to move it.
#pragma once

#include <vector>

#include "mpm/scene/scene.hpp"

namespace mpm {

struct ToolMotion {
  double fastest = 0.0;      ///< highest speed of its surface, of a free body at the start [m/s]
  double along = 0.0;        ///< way of its origin along gravity, to and fro [m]
  double across = 0.0;       ///< the same across gravity [m]
  bool turns = false;        ///< by one of its functions
  std::vector<Vec3> places;  ///< places of its origin, relative to where it starts, at equal times [m]
};

/// Over the run; over 10 s of one without an end. What functions do not tell at a time is left out: who moves the body
/// says so.
ToolMotion tool_motion(const RigidBodyDefinition& body, const SimulationDefinition& definition);

}  // namespace mpm
