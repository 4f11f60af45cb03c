// A physics other than the mechanics of the material: it meets the step at joints on the grid. A scene's
// list of stages is put together when it is loaded; what a scene does not name is not in the list.
#pragma once

#include <string>
#include <vector>

#include "mpm/math/state_archive.hpp"
#include "mpm/step/step_context.hpp"

namespace mpm {

/// Momentum that something outside gave to the material [N s], since the start.
struct ImpulseAccount {
  std::string name;
  Vec3 impulse = Vec3::Zero();
  double exchanged = 0.0;  ///< sum over steps of |impulse of the step|

  void add(const Vec3& step_impulse) {
    impulse += step_impulse;
    exchanged += step_impulse.norm();
  }
  void keep(StateArchive& archive) {
    archive.keep("impulse", impulse);
    archive.keep("exchanged", exchanged);
  }
};

class Stage {
 public:
  virtual ~Stage() = default;

  /// Mass and momentum are on the grid, velocity is momentum over mass: the place to find one's nodes.
  virtual void momentum_gathered(StepContext&) {}
  /// Grid.velocity is about to give the strain: impose conditions on it. Called once (USF, USL) or twice (USAVG) a
  /// step.
  virtual void before_strain(StepContext&) {}
  /// Grid.force holds the internal force: add to it [N].
  virtual void forces_gathered(StepContext&) {}
  /// Grid.velocity is v^{n+1}, Grid.force the acceleration: whoever adds dv to the one adds dv/dt to the other.
  virtual void momentum_updated(StepContext&) {}

  /// XPIC, FMPM: `velocity` [m/s], of the step's start or of its end, is about to be filtered: what holds a node gives
  /// it the velocity that it holds it at. It gives no momentum with that; the filter only must not see what the
  /// condition takes away anyhow.
  virtual void velocity_found(StepContext&, NodalField& /*velocity*/) {}
  /// XPIC, FMPM: `increment` [m/s] is about to be added to the velocity that particles adopt; what holds a node along
  /// some direction takes that part away, and owns up to the momentum. The sum of the increments' momentum is zero
  /// before.
  virtual void increment_found(StepContext&, NodalField& /*increment*/) {}

  /// The grid's velocities are what particles will take over: the step's impulse is known.
  virtual void grid_advanced(StepContext&) {}

  /// What this stage gave to the material, under its names.
  virtual void accounts(std::vector<ImpulseAccount>&) const {}

  /// Writes or reads what it remembers from step to step and what it reports, for checkpoints: all but what a step
  /// finds anew. Between two steps only.
  virtual void keep(StateArchive&) {}
};

}  // namespace mpm
