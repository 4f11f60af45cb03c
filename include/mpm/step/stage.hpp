// A module that acts on the grid in a step, at hooks. There are two kinds, and each sees what it needs: a Stage acts
// across all velocity fields, a FieldStage in one of them, and a run has one of these for each field. When they act is
// said by ranks (step/order.hpp).
#pragma once

#include "mpm/step/module.hpp"
#include "mpm/step/order.hpp"
#include "mpm/step/step_context.hpp"

namespace mpm {

/// `Context` is what a stage is handed at a hook.
template <class Context>
class StageWith : public Module {
 public:
  /// When it acts among the stages of a hook.
  virtual Ranks ranks(Hook hook) const = 0;

  /// The particles lie where the run starts and are sorted; nothing has been gathered. Once.
  virtual void run_begun(Context&) {}
  /// Mass and momentum are on the grid, velocity is momentum over mass: the place to find one's nodes.
  virtual void momentum_gathered(Context&) {}
  /// Grid::velocity is about to give the strain: impose conditions on it. Called once (USF, USL) or twice (USAVG) a
  /// step.
  virtual void before_strain(Context&) {}
  /// Grid::force holds the internal force: add to it [N].
  virtual void forces_gathered(Context&) {}
  /// Grid::velocity is v^{n+1}, Grid::force the acceleration: whoever adds dv to the one adds dv/dt to the other.
  virtual void momentum_updated(Context&) {}
  /// XPIC, FMPM: Grid::increment is a velocity [m/s], of the step's start or of its end, that is about to be filtered:
  /// what holds a node gives it the velocity that it holds it at. It gives no momentum with that; the filter only must
  /// not see what the condition takes away anyhow.
  virtual void velocity_found(Context&) {}
  /// XPIC, FMPM: Grid::increment [m/s] is about to be added to the velocity that particles adopt; what holds a node
  /// along some direction takes that part away, and owns up to the momentum. The sum of the increments' momentum is
  /// zero before.
  virtual void increment_found(Context&) {}
  /// The grid's velocities are what particles will take over: the step's impulse is known.
  virtual void grid_advanced(Context&) {}
};

/// Acts across velocity fields, or on particles of several.
using Stage = StageWith<StepContext>;
/// Acts in one velocity field.
using FieldStage = StageWith<FieldContext>;

}  // namespace mpm
