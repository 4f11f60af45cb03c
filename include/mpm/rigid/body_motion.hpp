// Motion of a rigid body: prescribed (by functions of time or commands), prescribed as a ring that opens, or free
// (rigid/free_motion.hpp). A body keeps one of these for the whole run; all have the same interface.
#pragma once

#include <string>

#include "mpm/rigid/motion.hpp"

namespace mpm {

/// The interface, with the defaults of a body whose motion is prescribed.
class BodyMotion {
 public:
  virtual ~BodyMotion() = default;

  /// The body's next twist. `prescribed`: by commands or functions of time; `own`: its present one.
  virtual Twist merged(const Twist& /*own*/, const Twist& prescribed) const { return prescribed; }
  /// Velocity of the surface at a world point [m/s].
  virtual Vec3 velocity_at(const Pose& pose, const Twist& twist, const Vec3& point) const {
    return mpm::velocity_at(pose, twist, point);
  }
  /// The largest velocity of a point of the surface over that of the origin, for a body that does not turn.
  virtual double spread(const Pose& /*pose*/) const { return 1.0; }
  /// The largest acceleration by forces [m/s^2]; 0 for prescribed motion. `gravity`: its magnitude.
  virtual double unprescribed_acceleration(double /*gravity*/) const { return 0.0; }
  /// Moves the pose by a step of `dt` [s]. @return the twist there.
  virtual Twist advance(Pose& pose, const Twist& twist, double dt) {
    pose = integrate(pose, twist, dt);
    return twist;
  }

  // Reason why a body refuses a command of this kind, and what to do instead; empty if it takes it.
  virtual std::string refused_velocity() const { return {}; }
  virtual std::string refused_pose() const { return {}; }
  /// Reason why the body cannot be at the pose, and what to do instead; empty if it can.
  virtual std::string refused(const Pose& /*pose*/) const { return {}; }

 protected:
  BodyMotion() = default;
  BodyMotion(const BodyMotion&) = default;
  BodyMotion& operator=(const BodyMotion&) = default;
};

class PrescribedMotion final : public BodyMotion {};

/// A ring about the axis of an axisymmetric scene, which opens and closes as its pose moves along x. Its inner
/// and outer faces move by the twist; a point beside one of them has a radial velocity in proportion to its radius.
class RingMotion final : public BodyMotion {
 public:
  /// Radii where the pose's x is 0 [m].
  RingMotion(double inner, double outer) : inner_(inner), outer_(outer) {}

  Vec3 velocity_at(const Pose& pose, const Twist& twist, const Vec3& point) const override;
  /// The middle of the section is fastest, since radii up to it move in proportion to the inner face.
  double spread(const Pose& pose) const override {
    const double opened = pose.position.x();
    return 0.5 * (inner_ + outer_ + 2.0 * opened) / (inner_ + opened);
  }
  std::string refused(const Pose& pose) const override;

 private:
  double inner_, outer_;
};

}  // namespace mpm
