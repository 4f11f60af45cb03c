// The free bodies among those that contact acts on: their velocities while contact is solved, and the impulse that
// contact gave to each.
#pragma once

#include <algorithm>
#include <vector>

#include "mpm/rigid/rigid_body.hpp"

namespace mpm {

class FreeBodies {
 public:
  /// `bodies` must outlive this object.
  FreeBodies(const std::vector<RigidBody*>& bodies, const Vec3& gravity)
      : bodies_(bodies), gravity_(gravity), taken_(bodies.size()) {}

  bool any() const {
    return std::any_of(bodies_.begin(), bodies_.end(),
                       [](const RigidBody* body) { return body->free_motion() != nullptr; });
  }
  /// Null for a body whose motion is prescribed.
  FreeMotion* motion(int body) const { return bodies_[body]->free_motion(); }
  /// Gives the bodies the velocities that the step would have without contact.
  void predict(double dt) {
    each([&](RigidBody& body, FreeMotion& motion, Taken&) { motion.predict(body.pose(), body.twist(), gravity_, dt); });
  }
  /// From here on velocities change for a trial, until end_trial() takes the changes back.
  void begin_trial() {
    each([](RigidBody& body, FreeMotion& motion, Taken&) { motion.begin_trial(body.pose(), body.twist()); });
  }
  void end_trial() {
    each([](RigidBody&, FreeMotion& motion, Taken&) { motion.end_trial(); });
  }
  /// From here on velocities are increments, until end_increment() adds them to the previous velocities.
  void begin_increment() {
    each([](RigidBody&, FreeMotion& motion, Taken&) { motion.begin_increment(); });
  }
  void end_increment() {
    each([](RigidBody&, FreeMotion& motion, Taken&) { motion.end_increment(); });
  }
  /// Books an impulse on the material [N s]. `mean_slip`: mean velocity of the material
  /// relative to the body [m/s].
  void take(int body, const Vec3& impulse, const Vec3& place, const Vec3& normal, const Vec3& mean_slip) {
    const FreeMotion* free = motion(body);
    if (free == nullptr) return;
    Taken& taken = taken_[body];
    taken.impulse.linear -= impulse;
    taken.impulse.angular -= (place - free->centre()).cross(impulse);
    taken.loss -= impulse.dot(normal) * mean_slip.dot(normal);
  }
  /// Call when all impulses are booked: gives the bodies the velocity that contact left them.
  void finish() {
    each([](RigidBody& body, FreeMotion& motion, Taken& taken) {
      motion.finish(taken.impulse, taken.loss);
      body.set_twist(motion.twist(body.pose()));
      taken = {};
    });
  }

 private:
  struct Taken {
    BodyMomentum impulse;
    double loss = 0.0;  ///< [J]
  };
  template <class Visit>
  void each(Visit&& visit) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (FreeMotion* motion = bodies_[b]->free_motion()) visit(*bodies_[b], *motion, taken_[b]);
    }
  }

  const std::vector<RigidBody*>& bodies_;
  Vec3 gravity_;  ///< [m/s^2]
  std::vector<Taken> taken_;
};

}  // namespace mpm
