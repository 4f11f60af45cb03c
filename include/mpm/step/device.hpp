// A processor that takes the steps of a run in memory of its own, as a graphics processor does (doc/gpu.md). The run
// keeps the clock, the limits of steps, the modules' reports and the checkpoints; its particle sets on the host are
// brought up to date only when somebody reads them. The modules of such a run act on no grid: the device asks them for
// what depends on time (rates of damping, loads, prescribed velocities) and books with them what it does in their
// place, so that accounts and checkpoints are those of a run on the processor.
#pragma once

#include <memory>
#include <vector>

#include "mpm/particles/particle_set.hpp"
#include "mpm/step/mechanics.hpp"
#include "mpm/step/modules.hpp"

namespace mpm {

/// The mechanics and the modules of a run, which outlive its device.
struct RunModules {
  Mechanics& mechanics;
  const Modules& modules;
};

class Device {
 public:
  /// The particle of a set that limits the time step.
  struct Fastest {
    double rate = 0.0;          ///< by which waves, motion and viscosity cross a cell [1/s]; NaN if any particle's is
    Vec3 place = Vec3::Zero();  ///< [m]
  };

  virtual ~Device() = default;

  /// Makes a step of `dt` [s] that begins at `start` [s]. @throws ModuleError naming a particle that has failed, or
  /// what has no value then; nothing can be stepped after that
  virtual void step(double start, double dt) = 0;
  /// Called between sync periods: fits the memory to where the particles are. @throws ModuleError
  virtual void make_room() = 0;
  /// `cell`: smallest edge of a cell [m].
  virtual Fastest fastest(int set, double cell) = 0;
  /// Momentum given since the last call by the wall at a face, 2 * grid axis, + 1 for the upper one.
  virtual ImpulseAccount take_given(int face) = 0;
  /// Books with the modules what was done in their place since the last call, but for walls.
  virtual void tell_modules() = 0;
  /// Writes the particles as they are now to the host's sets, each to where its id lies.
  virtual void fetch(std::vector<ParticleSet>& sets) const = 0;
  /// Goes on from these particles, in place of its own.
  virtual void take(const std::vector<ParticleSet>& sets) = 0;
};

}  // namespace mpm
