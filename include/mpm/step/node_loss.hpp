// Energy that a surface takes from the material at a node: by friction, and by holding it.
//
// The velocity after the forces and before contact is no slip: it holds what friction prevents, so that a body at rest
// on an incline would seem to lose energy. What is taken follows from the balance of a step. Particles gain the work of
// the node's forces, F and the impulse J of contact, on the mean of the velocities that they give to the node,
// (F dt + J).(V0 + V1)/2: V0 at the start of the step, V1 when their new momentum has been gathered. Strain takes the
// work of F on a (V0 + c0) + b (V1 + c1) instead, with the changes c that contact makes there (step/coulomb.hpp), and
// the parts a and b = 1 - a of the strain at the two ends: a = 1 for USF, 1/2 for USAVG, 0 for USL. With the velocity v
// of the surface, whose work is J.v, and the slip u = V + c - v, the material loses
//
//   -J.(u0 + u1)/2 + J.(c0 + c1)/2 + F dt.(a c0 + b c1),
//
// but for F dt.(V1 - V0)/2, which USF gains and USL loses without contact, too. The tangential part of the first term
// is friction: nothing where a node sticks, and where it slides, c_t = 0, all that the particles lose. The rest is the
// energy of motion that is held up, of a blow or of particles that move past a node which is held: F dt is the node's
// change of momentum less its weight and J. Nothing of earlier steps is needed.
//
// V1 is known after the step's impulse, and end() adds its terms. With USF, whose particles are not gathered again in
// the step, act() has the last word: it takes the slip that the impulse leaves on the grid in the place of u1, and for
// c1 what is expected, c0 where the node was held before.
// Gravity, whose work is in the potential energy, is no part of F. Weak: loads are; the difference is their impulse
// times (c0 + c1)/2.
#pragma once

#include "mpm/math/geometry.hpp"

namespace mpm {

/// Energy taken since the start [J].
struct SurfaceLoss {
  double friction = 0.0;
  double held = 0.0;  ///< of motion that is held up

  SurfaceLoss& operator+=(const SurfaceLoss& other) {
    friction += other.friction;
    held += other.held;
    return *this;
  }
};

/// Velocities are relative to the surface, in [m/s].
class NodeLoss {
 public:
  struct Act {
    double mass;                   ///< [kg]
    Vec3 normal;                   ///< of the surface
    Vec3 weight;                   ///< times the step [N s]
    Vec3 impulse;                  ///< on the material [N s]
    Vec3 start;                    ///< gathered at the start of the step
    Vec3 seen;                     ///< the same with the change that contact makes for strain
    Vec3 left;                     ///< that the impulse leaves on the grid
    Vec3 expected;                 ///< change that contact will make for strain
    double strain_at_start = 0.5;  ///< StepContext::strain_at_start
  };
  /// An impulse of the step, of which a wall may give two. Returns what it takes by the start of the step.
  SurfaceLoss act(const Act& act) {
    const Vec3 pressing = act.impulse.dot(act.normal) * act.normal, along = act.impulse - pressing;
    Vec3 pulled = act.mass * (act.left - (acted_ ? left_ : act.start)) - act.impulse;
    if (!acted_) pulled -= act.weight;
    acted_ = true;
    pressing_ += pressing;
    along_ += along;
    pulled_ += pulled;
    left_ = act.left;
    at_end_ = 1.0 - act.strain_at_start;
    SurfaceLoss taken = lost(pressing, along, pulled, act.seen, act.seen - act.start, act.strain_at_start);
    if (at_end_ == 0.0) taken += lost(pressing, along, pulled, act.left, act.expected, at_end_);
    return taken;
  }
  /// At the end of the step the velocity that was gathered, and the one that strain sees. Returns what this adds;
  /// nothing before act(), and with USF.
  SurfaceLoss end(const Vec3& gathered, const Vec3& seen) {
    SurfaceLoss more;
    if (at_end_ > 0.0) more = lost(pressing_, along_, pulled_, seen, seen - gathered, at_end_);
    *this = {};
    return more;
  }

 private:
  /// The terms of one end of the step, which has this part of the strain.
  static SurfaceLoss lost(const Vec3& pressing, const Vec3& along, const Vec3& pulled, const Vec3& slip,
                          const Vec3& change, double strain) {
    return {-0.5 * along.dot(slip),
            0.5 * ((pressing + along).dot(change) - pressing.dot(slip)) + strain * pulled.dot(change)};
  }

  bool acted_ = false;                                   ///< in this step
  Vec3 pressing_ = Vec3::Zero(), along_ = Vec3::Zero();  ///< parts of the impulse [N s]
  Vec3 pulled_ = Vec3::Zero();                           ///< F dt [N s]
  Vec3 left_ = Vec3::Zero();                             ///< [m/s]
  double at_end_ = 0.5;                                  ///< part of the strain at the end of the step
};

}  // namespace mpm
