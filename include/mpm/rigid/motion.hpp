// Pose and twist of a rigid body, and the two ways from one to the other.
//
// Twist: velocity of the body's origin and rotation rate, both in world axes, as geometry_msgs/Twist on a command
// topic. Held constant over an interval it moves the origin on a straight line and turns the body about a fixed
// world axis; both are integrated exactly (exponential map), so pose and twist never disagree.
#pragma once

#include "mpm/math/geometry.hpp"

namespace mpm {

struct Pose {
  Vec3 position = Vec3::Zero();         ///< origin of the body in the world [m]
  Quat orientation = Quat::Identity();  ///< rotates body axes to world axes; unit
  Vec3 to_world(const Vec3& body_point) const { return position + orientation * body_point; }
  Vec3 to_body(const Vec3& world_point) const { return orientation.conjugate() * (world_point - position); }
};

struct Twist {
  Vec3 linear = Vec3::Zero();   ///< velocity of the body's origin, world axes [m/s]
  Vec3 angular = Vec3::Zero();  ///< rotation rate, world axes [rad/s]
};

/// Force and torque; world axes; torque about the origin of the body it acts on.
struct Wrench {
  Vec3 force = Vec3::Zero();   ///< [N]
  Vec3 torque = Vec3::Zero();  ///< [N m]
};

/// The pose after `dt` [s] of constant twist. Exact for any dt; the result's quaternion is renormalised.
Pose integrate(const Pose& pose, const Twist& twist, double dt);

/// The constant twist that takes `from` to `to` in `dt` > 0 [s], turning the short way round.
Twist twist_between(const Pose& from, const Pose& to, double dt);

/// Bounds in the world of a box in the body's frame [m]; infinite along axes into which the box extends without end.
Box world_bounds(const Pose& pose, const Box& local);

/// Velocity of the body's material at a world point [m/s].
inline Vec3 velocity_at(const Pose& pose, const Twist& twist, const Vec3& world_point) {
  return twist.linear + twist.angular.cross(world_point - pose.position);
}

}  // namespace mpm
