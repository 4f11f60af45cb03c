// What the material did to a rigid body: plain values, SI.
#pragma once

#include <string>

#include "mpm/math/geometry.hpp"

namespace mpm {

/// Force and torque; world axes; torque about the origin of the body it acts on.
struct Wrench {
  Vec3 force = Vec3::Zero();   ///< [N]
  Vec3 torque = Vec3::Zero();  ///< [N m]
};

/// What the material did to one rigid body since the last report. Planar scenes: for the whole thickness.
struct ContactReport {
  std::string body;
  Wrench mean;                  ///< averaged over `interval`: applied impulse over time
  Wrench peak;                  ///< of the step with the largest force
  double interval = 0.0;        ///< [s] since the last report; 0 before the first step (then mean is zero)
  int nodes = 0;                ///< grid nodes in contact in the last step
  Vec3 impulse = Vec3::Zero();  ///< force on the body integrated since the start [N s]
};

}  // namespace mpm
