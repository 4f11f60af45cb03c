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
// strain() is told V0 and c0 before the impulse, V1 and c1 after it. With USL, whose strain does not see V0, c0 is what
// contact would change: it decides what is friction. With USF, whose particles are not gathered again in the step,
// act() has the last word: it takes the slip that the impulse leaves on the grid in the place of u1, and for c1 what is
// to be expected, c0 where the node was held before. Gravity, whose work is in the potential energy, is no
// part of F. Weak: loads are; the difference is their impulse times (c0 + c1)/2.
//
// Takes plain numbers, so that code of a device calls it as well.
#pragma once

namespace mpm {

/// Energy taken since the start [J].
struct SurfaceLoss {
  double friction = 0.0;
  double held = 0.0;  ///< energy of motion that is held up

  constexpr SurfaceLoss& operator+=(const SurfaceLoss& other) {
    friction += other.friction;
    held += other.held;
    return *this;
  }
};

/// Velocities are relative to the surface, in [m/s]. `Vector` has the operators, dot() and Zero() of Vec3.
template <class Vector>
class LossAtNode {
 public:
  struct Act {
    double mass;                   ///< [kg]
    Vector normal;                 ///< normal of the surface
    Vector weight;                 ///< times the step [N s]
    Vector impulse;                ///< on the material [N s]
    Vector start;                  ///< gathered at the start of the step
    Vector left;                   ///< that the impulse leaves on the grid
    bool held = false;             ///< true if the node was held in the step before
    double strain_at_start = 0.5;  ///< StepContext::strain_at_start
  };
  /// The impulse of the step. Returns what it takes by the start of the step.
  SurfaceLoss act(const Act& act) {
    acted_ = true;
    pressing_ = act.impulse.dot(act.normal) * act.normal;
    along_ = act.impulse - pressing_;
    pulled_ = act.mass * (act.left - act.start) - act.impulse - act.weight;
    at_end_ = 1.0 - act.strain_at_start;
    SurfaceLoss taken = lost(act.start + change_, change_, act.strain_at_start);
    if (at_end_ == 0.0) taken += lost(act.left, act.held ? change_ : Vector(Vector::Zero()), at_end_);
    return taken;
  }
  /// The velocity that was gathered, and the change that contact makes for strain. Returns what this adds at the end of
  /// the step; nothing before act(), and with USF.
  SurfaceLoss strain(const Vector& gathered, const Vector& change) {
    SurfaceLoss more;
    if (acted_ && at_end_ > 0.0) more = lost(gathered + change, change, at_end_);
    *this = {};
    change_ = change;
    return more;
  }

 private:
  /// The terms of one end of the step, which has this part of the strain.
  SurfaceLoss lost(const Vector& slip, const Vector& change, double strain) const {
    return {-0.5 * along_.dot(slip),
            0.5 * ((pressing_ + along_).dot(change) - pressing_.dot(slip)) + strain * pulled_.dot(change)};
  }

  bool acted_ = false;                                         ///< in this step
  Vector change_ = Vector::Zero();                             ///< for strain at the start of the step [m/s]
  Vector pressing_ = Vector::Zero(), along_ = Vector::Zero();  ///< parts of the impulse [N s]
  Vector pulled_ = Vector::Zero();                             ///< F dt [N s]
  double at_end_ = 0.5;                                        ///< part of the strain at the end of the step
};

/// The same of a surface that holds a node always along an axis, with a slip of 0 and c = -V there.
struct AxisLoss {
  double taken;   ///< by the start of the step [J]
  double at_end;  ///< energy that it takes by the end, over V1 [N s]
};
/// `momentum`: gathered at the start of the step; `weight`: times the step; `given`: impulse on the material [N s];
/// `removed`: velocity that was removed for the strain there [m/s]. With USF, where nothing is gathered any more, all
/// is taken at once if the node was held in the step before.
constexpr AxisLoss axis_loss(double mass, double momentum, double weight, double given, double removed, bool held,
                             double strain_at_start) {
  const double pulled = -momentum - weight - given, at_end = 0.5 * given + (1.0 - strain_at_start) * pulled;
  const double by_motion = strain_at_start == 1.0 && held ? 0.5 * given + at_end : 0.5 * given;
  return {-(by_motion * momentum / mass + strain_at_start * pulled * removed), at_end};
}

}  // namespace mpm
