// A motion that contact changes: that of a free body (rigid/free_motion.hpp) or of a robot's link
// (rigid/link_motion.hpp). While contact is solved, its velocity is an unknown like those of the nodes: an impulse at a
// point changes it at once, by the compliance there.
#pragma once

#include "mpm/rigid/body_motion.hpp"

namespace mpm {

class DynamicMotion : public BodyMotion {
 public:
  /// Present velocity, and the mean of that and the velocity at the step's start, at a world point [m/s].
  using BodyMotion::velocity_at;
  Vec3 velocity_at(const Vec3& point) const { return velocity_ + rate_.cross(point - centre_); }
  Vec3 mean_velocity_at(const Vec3& point) const {
    return 0.5 * (velocity_ + start_velocity_ + (rate_ + start_rate_).cross(point - centre_));
  }
  /// Applies an impulse [N s] at a world point.
  virtual void push(const Vec3& impulse, const Vec3& point) = 0;
  /// Change of velocity of a world point by a unit impulse there, along each pair of axes [1/kg].
  virtual Mat3 compliance_at(const Vec3& point) const = 0;
  /// The point about which velocities and impulses are counted: the centre of mass, or the origin of a link [m].
  const Vec3& centre() const { return centre_; }
  /// The present twist of the body's origin.
  Twist twist(const Pose& pose) const { return {velocity_ + rate_.cross(pose.position - centre_), rate_}; }

 protected:
  Vec3 centre_ = Vec3::Zero();
  Vec3 velocity_ = Vec3::Zero(), rate_ = Vec3::Zero();
  Vec3 start_velocity_ = Vec3::Zero(), start_rate_ = Vec3::Zero();
};

}  // namespace mpm
