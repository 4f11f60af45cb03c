// The passes of the mechanics, as a schedule sees them: one virtual call a pass, none a particle. A pass is over all
// velocity fields.
#pragma once

#include <optional>

#include "mpm/step/module.hpp"
#include "mpm/step/sorter.hpp"
#include "mpm/step/step_context.hpp"

namespace mpm {

/// A particle that limits the time step.
struct FastestParticle {
  double rate = -1.0;  ///< of its waves, motion and viscosity, across a cell [1/s]; not a number if that of any is not
  int index = 0;       ///< in its set
};

class Mechanics : public Module {
 public:
  std::string name() const override { return "mechanics"; }

  /// Mass and momentum to the grid; velocity = momentum / mass.
  virtual void scatter_momentum(StepContext&) = 0;
  /// Strain and stress advance by `dt` with the grid's velocity; then the internal force goes to the grid.
  virtual void strain_and_force(StepContext&, double dt) = 0;
  /// The internal force of the stress as it is goes to the grid.
  virtual void internal_force(StepContext&) = 0;
  /// velocity = v^{n+1}, force = acceleration, from momentum, force and gravity.
  virtual void update_momentum(StepContext&) = 0;
  /// XPIC and FMPM: how many increments the velocity that particles adopt takes, after momentum was updated.
  virtual int increments() const = 0;
  /// Grid.increment becomes the velocity that they are made of; conditions may act on it before.
  virtual void begin_increments(StepContext&) = 0;
  /// Grid.increment becomes the next one; conditions may act on it before it is added to the grid's velocity.
  virtual void find_increment(StepContext&) = 0;
  virtual void add_increment(StepContext&) = 0;
  /// Velocity and position of the particles.
  virtual void move_particles(StepContext&) = 0;
  /// Velocity of the particles; their new momentum to the grid with this step's weights; velocity = momentum / mass.
  virtual void move_and_regather(StepContext&) = 0;
  /// Strain and stress advance by `dt`; then positions take their new value. Goes with move_and_regather().
  virtual void strain_and_place(StepContext&, double dt) = 0;

  /// A particle whose J is not positive (or not finite), found in the step, if there is one; the same one for any
  /// number of threads.
  virtual std::optional<ParticleRef> failed() const = 0;
  /// Of the particles of a set, in their present state; of equal rates the first one. `cell`: the smallest edge [m].
  virtual FastestParticle fastest(int set, double cell) const = 0;
  /// Also when so many particles have left their groups that it pays.
  bool needs_sort() const override = 0;
};

}  // namespace mpm
