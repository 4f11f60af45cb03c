// The passes of the mechanics, which a schedule calls in its order. There is one virtual call for each pass, over all
// velocity fields, and none for a particle.
#pragma once

#include <optional>

#include "mpm/step/module.hpp"
#include "mpm/step/sorter.hpp"
#include "mpm/step/step_context.hpp"

namespace mpm {

/// The particle of a set that limits the time step.
struct FastestParticle {
  double rate = -1.0;  ///< by which waves, motion and viscosity cross a cell [1/s]; NaN if that of any particle is
  int index = 0;       ///< in its set
};

class Mechanics : public Module {
 public:
  std::string name() const override { return "mechanics"; }

  /// Spreads mass and momentum to the grid; velocity = momentum / mass.
  virtual void scatter_momentum(StepContext&) = 0;
  /// Advances strain and stress by `dt` with the grid's velocity, then spreads the internal force.
  virtual void strain_and_force(StepContext&, double dt) = 0;
  /// Spreads the internal force of the present stress.
  virtual void internal_force(StepContext&) = 0;
  /// No force on any node, for a step whose internal forces are found with the velocities of its end.
  virtual void clear_forces(StepContext&) = 0;
  /// velocity = v^{n+1}, force = acceleration, from momentum, force and gravity.
  virtual void update_momentum(StepContext&) = 0;
  /// XPIC, also mixed with FLIP, and FMPM: number of increments that make up the velocity which particles adopt, after
  /// momentum was updated.
  virtual int increments() const = 0;
  /// Sets Grid::increment to the velocity from which increments are computed; conditions may act on it before.
  virtual void begin_increments(StepContext&) = 0;
  /// Sets Grid::increment to the next increment; conditions may act on it before it is added to the grid's velocity.
  virtual void find_increment(StepContext&) = 0;
  virtual void add_increment(StepContext&) = 0;
  /// Updates velocity and position of the particles.
  virtual void move_particles(StepContext&) = 0;
  /// Updates the velocity of the particles and spreads their new momentum with this step's weights; velocity = momentum
  /// / mass.
  virtual void move_and_regather(StepContext&) = 0;
  /// Advances strain and stress by `dt`, then updates positions. To be called after move_and_regather().
  virtual void strain_and_place(StepContext&, double dt) = 0;

  /// A particle whose J is not positive (or not finite), found in the step, if there is one; the same one for any
  /// number of threads.
  virtual std::optional<ParticleRef> failed() const = 0;
  /// The fastest particle of a set in its present state; of equal rates the first one. `cell`: the smallest edge [m].
  virtual FastestParticle fastest(int set, double cell) const = 0;
  /// Groups of particles, and parts that are gathered one by one, more than after the last sort.
  struct Mixed {
    double groups = 0.0, parts = 0.0;
    /// So many particles have left their groups that a sort pays.
    bool too_much() const { return parts > kMixed * groups; }
    static constexpr double kMixed = 0.2;  ///< part of the groups that may be gathered twice before
  };
  virtual Mixed mixed() const = 0;
  /// Particles have left the reach of their block.
  virtual bool must_sort() const = 0;
  /// After the blocks have been made anew while particles lie as they have been sorted before.
  virtual void blocks_renewed() = 0;

  // Functions for a device that takes the steps (step/device.hpp).

  /// Books kinetic energy that PIC and damping have taken there [J].
  virtual void count(double slip, double drag) = 0;
  /// Steps since one in which the transfer's fraction of FLIP held.
  virtual std::int32_t& turn() = 0;

  /// Over several ranks it is said by sums over all: what depends on when particles are sorted
  /// (mechanics/stress_average.hpp) does not depend on the number of ranks.
  bool needs_sort() const final { return must_sort() || mixed().too_much(); }
};

}  // namespace mpm
