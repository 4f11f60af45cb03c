// The box around a rigid surface where it stands now.
#pragma once

#include <algorithm>

#include "mpm/rigid/rigid_body.hpp"

namespace mpm {

/// In the world [m]; a body that is endless along an axis stays endless.
inline Box world_bounds(const RigidBody& body) {
  const Box local = body.surface().bounds();
  const Mat3 rotation = body.pose().orientation.toRotationMatrix();
  Box world{body.pose().position, body.pose().position};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (rotation(i, k) == 0.0) continue;  // times an endless edge
      const double a = rotation(i, k) * local.min[k], b = rotation(i, k) * local.max[k];
      world.min[i] += std::min(a, b);
      world.max[i] += std::max(a, b);
    }
  }
  return world;
}

}  // namespace mpm
