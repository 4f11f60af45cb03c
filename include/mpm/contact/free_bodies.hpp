// The free bodies and the robots among those that contact acts on: their velocities while contact is solved, the
// impulse that contact gave to each, and where bodies meet each other.
#pragma once

#include <algorithm>
#include <vector>

#include "mpm/contact/body_contact.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/step/energy.hpp"

namespace mpm {

class FreeBodies {
 public:
  /// `bodies` must outlive this object. @throws RigidError as BodyContact does
  FreeBodies(const std::vector<RigidBody*>& bodies, const Vec3& gravity, const BodyContactSettings& meeting)
      : bodies_(bodies), gravity_(gravity), taken_(bodies.size()), meeting_(bodies, meeting) {
    for (RigidBody* body : bodies_) {
      const LinkMotion* link = body->link_motion();
      if (link == nullptr) continue;
      if (std::find(robots_.begin(), robots_.end(), &link->robot()) == robots_.end()) robots_.push_back(&link->robot());
    }
  }

  /// True if impulses move some body.
  bool any() const {
    return std::any_of(bodies_.begin(), bodies_.end(),
                       [](RigidBody* body) { return body->dynamic_motion() != nullptr; });
  }
  /// Null for a body whose motion is prescribed.
  DynamicMotion* motion(int body) const { return bodies_[body]->dynamic_motion(); }
  /// Finds where bodies may meet each other, or walls, in the step.
  void find_meetings(double dt) {
    if (meeting_.any()) meeting_.find(dt);
  }
  /// Rows of that, for a solution that then begins; null where none may.
  BodyContact* begin_meeting() {
    if (!meeting_.touches()) return nullptr;
    meeting_.begin();
    return &meeting_;
  }
  /// Rows of that within a solution, when settle() has changed compliances.
  BodyContact* same_meeting() {
    if (!meeting_.touches()) return nullptr;
    meeting_.find_compliance();
    return &meeting_;
  }
  /// Gives the bodies the velocities that the step would have without contact.
  void predict(double dt) {
    each([&](RigidBody& body, FreeMotion& motion, Taken&) { motion.predict(body.pose(), body.twist(), gravity_, dt); });
    for (Articulation* robot : robots_) robot->predict(dt);
  }
  /// From here on velocities change for a trial, until end_trial() takes the changes back.
  void begin_trial() {
    each([](RigidBody& body, FreeMotion& motion, Taken&) { motion.begin_trial(body.pose(), body.twist()); });
    for (Articulation* robot : robots_) robot->begin_trial();
  }
  void end_trial() {
    each([](RigidBody&, FreeMotion& motion, Taken&) { motion.end_trial(); });
    for (Articulation* robot : robots_) robot->end_trial();
  }
  /// From here on velocities are increments, until end_increment() adds them to the previous velocities.
  void begin_increment() {
    each([](RigidBody&, FreeMotion& motion, Taken&) { motion.begin_increment(); });
    for (Articulation* robot : robots_) robot->begin_increment();
  }
  void end_increment() {
    each([](RigidBody&, FreeMotion& motion, Taken&) { motion.end_increment(); });
    for (Articulation* robot : robots_) robot->end_increment();
  }
  /// Looks whether the joints of robots act as assumed. Where one does not, compliances and velocities of bodies are
  /// new, and contact has to be solved again.
  bool settle() {
    bool changed = false;
    for (Articulation* robot : robots_) changed = robot->settle() || changed;
    return changed;
  }
  /// Books an impulse on the material [N s]. `mean_slip`: mean velocity of the material
  /// relative to the body [m/s].
  void take(int body, const Vec3& impulse, const Vec3& place, const Vec3& normal, const Vec3& mean_slip) {
    give(body, -impulse, place, -impulse.dot(normal) * mean_slip.dot(normal));
  }
  /// Books the impulses of bodies on each other. `with_loss`: not of an increment.
  void take_meetings(bool with_loss) {
    meeting_.each_impulse(with_loss, [&](const BodyImpulse& given) {
      // The loss counts once: with a body that can move.
      const bool first = bodies_[given.body]->dynamic_motion() != nullptr;
      const int prescribed = first ? given.other : given.body;
      // The drives of a robot have the work of its links.
      if (prescribed >= 0 && bodies_[prescribed]->link_motion() == nullptr) pushed_ += given.pushed;
      give(given.body, given.impulse, given.place, first ? given.loss : 0.0);
      if (given.other >= 0) give(given.other, -given.impulse, given.place, first ? 0.0 : given.loss);
    });
  }
  /// "collision_work", of bodies with a prescribed motion on others.
  void energies(EnergyReport& report) const {
    if (meeting_.any()) report.add("collision_work", NamedEnergy::Kind::at_bodies, pushed_);
  }
  void serialise(StateArchive& archive) {
    if (meeting_.any()) archive.value("collision_work", pushed_);
  }
  void check_overlaps(const RigidBody& body) const { meeting_.check_overlaps(&body); }
  /// Call when all impulses are booked: gives the bodies the velocity that contact left them.
  void finish() {
    each([](RigidBody& body, FreeMotion& motion, Taken& taken) {
      motion.finish(taken.impulse, taken.loss);
      body.set_twist(motion.twist(body.pose()));
      taken = {};
    });
    for (Articulation* robot : robots_) robot->finish();
  }

 private:
  struct Taken {
    BodyMomentum impulse;
    double loss = 0.0;  ///< [J]
  };
  /// Books an impulse on the body, and what was lost there [J].
  void give(int body, const Vec3& impulse, const Vec3& place, double loss) {
    if (LinkMotion* link = bodies_[body]->link_motion()) {
      link->take(impulse, place, loss);
      return;
    }
    const FreeMotion* free = bodies_[body]->free_motion();
    if (free == nullptr) return;
    Taken& taken = taken_[body];
    taken.impulse.linear += impulse;
    taken.impulse.angular += (place - free->centre()).cross(impulse);
    taken.loss += loss;
  }
  template <class Visit>
  void each(Visit&& visit) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (FreeMotion* motion = bodies_[b]->free_motion()) visit(*bodies_[b], *motion, taken_[b]);
    }
  }

  const std::vector<RigidBody*>& bodies_;
  Vec3 gravity_;  ///< [m/s^2]
  std::vector<Taken> taken_;
  std::vector<Articulation*> robots_;
  BodyContact meeting_;
  double pushed_ = 0.0;  ///< [J]
};

}  // namespace mpm
