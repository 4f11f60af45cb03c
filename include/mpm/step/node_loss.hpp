// Energy that a surface takes from the material at a node: by friction, and by holding it.
//
// The velocity after the forces and before contact is no slip: it holds what friction prevents, so that a body at rest
// on an incline would seem to lose energy. What is taken follows from the balance of a step. Particles gain the work of
// the node's forces, F and the impulse J of contact, on the mean of the velocities that they give to the node,
// (F dt + J).(V0 + V1)/2: V0 at the start of the step, V1 when their new momentum has been gathered. Strain takes the
// work of F on (V0 + c0 + V1 + c1)/2 instead, with the changes c that contact makes there (step/coulomb.hpp). With the
// velocity v of the surface, whose work is J.v, and the slip u = V + c - v that strain sees, the material loses
//
//   -J.(u0 + u1)/2 + (F dt + J).(c0 + c1)/2.
//
// The tangential part of the first term is friction: nothing where a node sticks, and where it slides, c_t = 0, all
// that the particles lose. The rest is the energy of motion that is held up, of a blow or of particles that move past a
// node which is held: F dt + J is the node's change of momentum less its weight. Nothing of earlier steps is needed.
//
// V1 is known after the step's impulse: act() takes the slip that the impulse leaves on the grid in the place of u1,
// and 0 for c1; end() replaces them. With USF, whose particles are not gathered again, act() has the last word.
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
    double mass;   ///< [kg]
    Vec3 normal;   ///< of the surface
    Vec3 weight;   ///< times the step [N s]
    Vec3 impulse;  ///< on the material [N s]
    Vec3 start;    ///< gathered at the start of the step
    Vec3 seen;     ///< by strain then
    Vec3 left;     ///< that the impulse leaves on the grid
  };
  /// An impulse of the step, of which a wall may give two. Returns what it takes if nothing is gathered any more.
  SurfaceLoss act(const Act& act) {
    const Vec3 pressing = act.impulse.dot(act.normal) * act.normal, along = act.impulse - pressing;
    Vec3 gained = act.mass * (act.left - (acted_ ? left_ : act.start));
    if (!acted_) gained -= act.weight;
    acted_ = true;
    pressing_ += pressing;
    along_ += along;
    gained_ += gained;
    left_ = act.left;
    SurfaceLoss taken = change_to({-0.5 * along_.dot(left_), -0.5 * pressing_.dot(left_)});
    taken += {-0.5 * along.dot(act.seen), 0.5 * (gained.dot(act.seen - act.start) - pressing.dot(act.seen))};
    return taken;
  }
  /// At the end of the step the velocity that was gathered, and the one that strain sees. Returns what this adds;
  /// nothing before act().
  SurfaceLoss end(const Vec3& gathered, const Vec3& seen) {
    const SurfaceLoss more =
        change_to({-0.5 * along_.dot(seen), 0.5 * (gained_.dot(seen - gathered) - pressing_.dot(seen))});
    *this = {};
    return more;
  }

 private:
  /// From what was counted for the end of the step.
  SurfaceLoss change_to(const SurfaceLoss& end) {
    const SurfaceLoss change{end.friction - end_.friction, end.held - end_.held};
    end_ = end;
    return change;
  }

  bool acted_ = false;                                   ///< in this step
  Vec3 pressing_ = Vec3::Zero(), along_ = Vec3::Zero();  ///< parts of the impulse [N s]
  Vec3 gained_ = Vec3::Zero();                           ///< change of the node's momentum [N s]
  Vec3 left_ = Vec3::Zero();                             ///< [m/s]
  SurfaceLoss end_;                                      ///< counted for the end of the step
};

}  // namespace mpm
