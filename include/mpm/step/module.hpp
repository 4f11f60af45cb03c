// A module is a physics beside the mechanics of the material. It owns what it adds to a run: impulses, energies,
// numbers, step limits and state. The run's list (step/modules.hpp) holds only the modules that the scene names. A
// module that acts on the grid is a Stage (step/stage.hpp).
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
#include "mpm/ranks/communicator.hpp"
#include "mpm/step/energy.hpp"
#include "mpm/step/step_limit.hpp"

namespace mpm {

class Device;
class RigidBody;

/// Momentum given to the material from outside since the start [N s], under one name.
struct ImpulseAccount {
  std::string name;
  Vec3 impulse = Vec3::Zero();
  double exchanged = 0.0;  ///< sum over steps of |impulse of the step|

  void add(const Vec3& step_impulse) {
    impulse += step_impulse;
    exchanged += step_impulse.norm();
  }
  void serialise(StateArchive& archive) {
    archive.sum("impulse", impulse);
    archive.sum("exchanged", exchanged);
  }
};

/// A number of the whole run that a module adds, for reports and as a global quantity.
struct NamedNumber {
  std::string name, unit;
  double value = 0.0;
};

/// Reason why a particle is outside the grid, and what may help.
struct OutsideReason {
  std::string what, remedy;
};

/// A failure of a module in a step. what() names the cause, the time and the remedy. It ends a run as a PhysicsError.
class ModuleError : public Error {
 public:
  using Error::Error;
};

class Module {
 public:
  virtual ~Module() = default;

  /// The module's name, such as "wall/z_min". It also names the module's part of a checkpoint.
  virtual std::string name() const = 0;

  // Reports, which are computed when asked for, between two steps.

  /// Over several ranks: whether what the module reports is the whole run's on each of them, so that one alone counts.
  /// Else it is this rank's part.
  virtual bool same_on_all_ranks() const { return false; }

  /// Over several ranks: called when particles have been sorted and blocks may have come to ranks which did not have
  /// them. What the module remembers of nodes from the step before has to be known there. Collective.
  virtual void share_memory(Communicator&) {}

  /// Adds the module's impulse accounts to the list.
  virtual void accounts(std::vector<ImpulseAccount>&) const {}
  /// Adds the energies that the module stores, dissipates or gives as work [J]. A module that sets material in motion
  /// has to add its work: a run that moves with energy of no source is ended as one that blows up.
  virtual void energies(EnergyReport&) const {}
  /// Adds other numbers of the module.
  virtual void numbers(std::vector<NamedNumber>&) const {}

  // Limits of the time step.

  /// Tightens the limit of the steps of a period. @throws Error when a function of time is not finite in it
  virtual void limit_step(const PeriodAhead&, StepLimit&) const {}
  /// The text of a limit that this module has set.
  virtual std::string limit_text(const StepLimit&) const { return name(); }

  // Actions beside the grid.

  /// Called when particles and bodies have moved, before it is decided whether particles are sorted.
  virtual void step_ended() {}
  /// Called at the end of a sync period; `time` [ns]. @throws Error when a body is at a forbidden place
  virtual void at_sync(std::int64_t /*time*/) {}

  /// Called before that is accepted. @throws Error when the body cannot be where it is now
  virtual void check_put(const RigidBody&) const {}
  /// Called between two steps when a rigid body has been put elsewhere: what the module remembers of it is of no use.
  virtual void body_put(const RigidBody&) {}
  /// Called before particles are sorted: the last chance to move them or to choose their velocity fields.
  virtual void before_sort() {}
  /// True if particles have to be sorted after this step.
  virtual bool needs_sort() const { return false; }
  /// Called when a particle is outside the grid. Returns whether the module has put all such particles back, so that
  /// the sort can be tried again. Over several ranks it is called on all when one has such a particle, and returns the
  /// same on all.
  virtual bool put_back() { return false; }
  /// The reason why a particle is outside the grid, if this module knows it.
  virtual std::optional<OutsideReason> why_outside(const GridLayout&, const ParticleSet&, int /*particle*/) const {
    return std::nullopt;
  }

  // Exchange with a device that takes the steps (step/device.hpp), in which stages do not act.

  /// Books what the device has done since the last call in the module's place.
  virtual void count(Device&) {}
  /// Takes over what the device remembers from step to step, before a checkpoint is written.
  virtual void learn(const Device&) {}
  /// Gives the device that memory, before it takes its first step from this state.
  virtual void teach(Device&) const {}

  // State.

  /// Writes or reads the module's state and reports, for checkpoints: all but what every step computes anew. To be
  /// called between two steps only.
  virtual void serialise(StateArchive&) {}
  /// Adds the numbers that belong to the state hash because the run's future depends on them.
  virtual void hashed(std::vector<double>&) const {}
};

}  // namespace mpm
