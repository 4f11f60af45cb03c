// A module that acts on the grid in a step, at hooks. There are two kinds, and each is handed what it needs: a
// Stage acts across all velocity fields, a FieldStage in one of them, and a run has one of these for each field. Ranks
// decide in which order they act (step/order.hpp).
#pragma once

#include "mpm/step/module.hpp"
#include "mpm/step/order.hpp"
#include "mpm/step/step_context.hpp"

namespace mpm {

/// A stage that is handed a `Context` at each hook.
template <class Context>
class StageWith : public Module {
 public:
  /// The stage's place among the stages at a hook.
  virtual Ranks ranks(Hook hook) const = 0;

  /// Called once, before the first step: particles are at their initial positions and sorted; nothing has been
  /// gathered.
  virtual void run_begun(Context&) {}
  /// A step begins: nothing of it has been gathered. Particles may choose their fields here, and change places.
  virtual void step_begun(Context&) {}
  /// Mass and momentum are on the grid, velocity is momentum over mass. Stages find their nodes here.
  virtual void momentum_gathered(Context&) {}
  /// The strain is about to be computed from Grid::velocity: impose conditions on it. Called once (USF, USL) or twice
  /// (USAVG) in a step.
  virtual void before_strain(Context&) {}
  /// Grid::force holds the internal force: add to it [N].
  virtual void forces_gathered(Context&) {}
  /// Grid::velocity is v^{n+1}, Grid::force the acceleration: a stage that adds dv to the one adds dv/dt to the other.
  virtual void momentum_updated(Context&) {}
  /// XPIC, also mixed with FLIP, and FMPM: Grid::increment is a velocity [m/s], of the step's start or of its end, that
  /// is about to be filtered: a stage that holds a node sets the velocity at which it holds it. This exchanges no
  /// momentum; it only keeps from the filter what the condition removes anyhow.
  virtual void velocity_found(Context&) {}
  /// XPIC, FMPM: Grid::increment [m/s] is about to be added to the velocity that particles adopt; a stage that
  /// holds a node along a direction removes that component, and books the momentum. Before that the increments'
  /// momentum sums to zero. Where XPIC is mixed with FLIP it is the part of it that particles take over, and is added
  /// to the acceleration, too.
  virtual void increment_found(Context&) {}
  /// The grid's velocities are final, and the step's impulse is known.
  virtual void grid_advanced(Context&) {}
};

/// A stage that acts across velocity fields, or on particles of several.
using Stage = StageWith<StepContext>;
/// A stage that acts in one velocity field.
using FieldStage = StageWith<FieldContext>;

}  // namespace mpm
