// A physics beside the mechanics of the material, as a run sees it: it owns what it adds. What a scene does not name is
// not in the run's list (step/modules.hpp). Where it acts on the grid it is a Stage (step/stage.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mpm/grid/grid_layout.hpp"
#include "mpm/math/error.hpp"
#include "mpm/math/geometry.hpp"
#include "mpm/math/state_archive.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/energy.hpp"
#include "mpm/step/step_limit.hpp"

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
  void serialise(StateArchive& archive) {
    archive.value("impulse", impulse);
    archive.value("exchanged", exchanged);
  }
};

/// A number of the whole run that a module brings, for reports and as a global quantity.
struct NamedNumber {
  std::string name, unit;
  double value = 0.0;
};

/// Why a particle is outside the grid, and what may help.
struct OutsideReason {
  std::string what, remedy;
};

/// What a module cannot do in a step. what() names what and when, and the remedy. Ends a run as a PhysicsError.
class ModuleError : public Error {
 public:
  using Error::Error;
};

class Module {
 public:
  virtual ~Module() = default;

  /// What this is, as in "wall/z_min". Names its part of a checkpoint.
  virtual std::string name() const = 0;

  // What it reports. Computed when asked for, between two steps.

  /// What it gave to the material, under its names.
  virtual void accounts(std::vector<ImpulseAccount>&) const {}
  /// Energies that it stores, takes or works [J].
  virtual void energies(EnergyReport&) const {}
  /// Other numbers of its own.
  virtual void numbers(std::vector<NamedNumber>&) const {}

  // What it asks of the time step.

  /// Tightens the limit of the steps of a period. @throws Error when something has no value in it
  virtual void limit_step(const PeriodAhead&, StepLimit&) const {}
  /// A limit of its own in words.
  virtual std::string limit_text(const StepLimit&) const { return name(); }

  // What it does beside the grid.

  /// A sync period has ended; `time` [ns]. @throws Error when something stands where it may not
  virtual void at_sync(std::int64_t /*time*/) {}

  /// Particles are about to be sorted: the last time to move them, or to choose their velocity fields.
  virtual void before_sort() {}
  /// Asks for a sort after this step.
  virtual bool needs_sort() const { return false; }
  /// Some particle is outside the grid: whether this has put it back, so that the sort can be tried again.
  virtual bool put_back() { return false; }
  /// Why a particle is outside and stays there, if this knows it.
  virtual std::optional<OutsideReason> why_outside(const GridLayout&, const ParticleSet&, int /*particle*/) const {
    return std::nullopt;
  }

  // What it remembers.

  /// Writes or reads what it remembers from step to step and what it reports, for checkpoints: all but what a step
  /// finds anew. Between two steps only.
  virtual void serialise(StateArchive&) {}
  /// Numbers that decide the future and belong to the state hash.
  virtual void hashed(std::vector<double>&) const {}
};

}  // namespace mpm
