// Limits of the motion that commands give to a rigid body.
#pragma once

#include <limits>

namespace mpm {

/// Limits on the norms of velocities and accelerations; infinite: no limit.
struct MotionLimits {
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  double speed = kNone;                  ///< speed of the body's origin [m/s]
  double rotation_rate = kNone;          ///< [rad/s]
  double acceleration = kNone;           ///< acceleration of the body's origin [m/s^2]
  double rotation_acceleration = kNone;  ///< [rad/s^2]

  bool any() const {
    return speed < kNone || rotation_rate < kNone || acceleration < kNone || rotation_acceleration < kNone;
  }
};

}  // namespace mpm
