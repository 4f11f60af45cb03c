// A physics beside the mechanics of the material, as a run sees it: it owns what it adds. What a scene does not name is
// not in the run's list (step/modules.hpp). Where it acts on the grid it is a Stage (step/stage.hpp).
#pragma once

#include <string>
#include <vector>

#include "mpm/math/geometry.hpp"
#include "mpm/math/state_archive.hpp"

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

class Module {
 public:
  virtual ~Module() = default;

  /// What this is, as in "wall/z_min". Names its part of a checkpoint.
  virtual std::string name() const = 0;

  /// What it gave to the material, under its names.
  virtual void accounts(std::vector<ImpulseAccount>&) const {}

  /// Writes or reads what it remembers from step to step and what it reports, for checkpoints: all but what a step
  /// finds anew. Between two steps only.
  virtual void keep(StateArchive&) {}
};

}  // namespace mpm
