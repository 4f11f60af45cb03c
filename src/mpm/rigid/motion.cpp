// Exponential and logarithm of rotations by unit quaternions (angle and axis), stable from zero to half a turn.
#include "mpm/rigid/motion.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {

namespace {

/// The quaternion of a rotation vector (axis times angle) [rad].
Quat rotation_exp(const Vec3& rotation) {
  const double half = 0.5 * rotation.stableNorm();
  // sin(half) / (2 half): the series' first term is exact to double precision where the quotient would be 0/0.
  const double scale = half > 1e-9 ? 0.5 * std::sin(half) / half : 0.5;
  const Vec3 v = scale * rotation;
  return Quat(std::cos(half), v.x(), v.y(), v.z()).normalized();
}

/// The rotation vector of a unit quaternion, the short way round: angle in [0, pi] [rad].
Vec3 rotation_log(const Quat& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;  // q and -q turn alike; w >= 0 is the short way
  const double sine = q.vec().stableNorm();
  // atan2 keeps full precision both near zero (where acos(w) would not) and near half a turn (where asin would not).
  const double scale = sine > 0.0 ? 2.0 * std::atan2(sine, std::abs(q.w())) / sine : 2.0;
  return sign * scale * q.vec();
}

}  // namespace

Pose integrate(const Pose& pose, const Twist& twist, double dt) {
  Pose result;
  result.position = pose.position + dt * twist.linear;
  // World axes: the turn is applied after the present orientation.
  result.orientation = (rotation_exp(dt * twist.angular) * pose.orientation).normalized();
  return result;
}

Twist twist_between(const Pose& from, const Pose& to, double dt) {
  Twist twist;
  twist.linear = (to.position - from.position) / dt;
  twist.angular = rotation_log(to.orientation * from.orientation.conjugate()) / dt;
  return twist;
}

Box world_bounds(const Pose& pose, const Box& local) {
  const Mat3 rotation = pose.orientation.toRotationMatrix();
  Box world{pose.position, pose.position};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (rotation(i, k) == 0.0) continue;  // times an infinite edge it would be no number
      const double a = rotation(i, k) * local.min[k], b = rotation(i, k) * local.max[k];
      world.min[i] += std::min(a, b);
      world.max[i] += std::max(a, b);
    }
  }
  return world;
}

}  // namespace mpm
