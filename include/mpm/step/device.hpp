// A processor that takes the steps of a run in memory of its own, as a graphics processor does (doc/gpu.md). The run
// keeps the clock, the limits of steps, the modules' reports and the checkpoints; its particle sets on the host are
// brought up to date only when somebody reads them. The modules of such a run act on no grid: what the device does in
// their place it tells them, so that accounts and checkpoints are those of a run on the processor.
#pragma once

#include <memory>
#include <vector>

#include "mpm/particles/particle_set.hpp"
#include "mpm/step/coulomb.hpp"
#include "mpm/step/module.hpp"
#include "mpm/step/surface_loss.hpp"

namespace mpm {

class Device {
 public:
  /// The particle of a set that limits the time step.
  struct Fastest {
    double rate = 0.0;          ///< by which waves, motion and viscosity cross a cell [1/s]; NaN if any particle's is
    Vec3 place = Vec3::Zero();  ///< [m]
  };

  virtual ~Device() = default;

  /// Makes a step of `dt` [s]. @throws ModuleError naming a particle that has failed; nothing can be stepped then
  virtual void step(double dt) = 0;
  /// Called between sync periods: fits the memory to where the particles are. @throws ModuleError
  virtual void make_room() = 0;
  /// `cell`: smallest edge of a cell [m].
  virtual Fastest fastest(int set, double cell) = 0;
  /// Sums since the last call of the wall at a face, 2 * grid axis, + 1 for the upper one: given, and taken.
  struct OfWall {
    ImpulseAccount given;
    SurfaceLoss loss;
  };
  virtual OfWall take_wall(int face) = 0;
  /// Energy that PIC has taken since the last call, and mean stresses [J].
  virtual double take_slip() = 0;
  virtual double take_averaged() = 0;
  /// Nodes that the wall at a face held in the last step; none where no step needs it of the one before.
  virtual HeldNodes held(int face) const = 0;
  /// Goes on from these; after take().
  virtual void hold(int face, const HeldNodes& nodes) = 0;
  /// Writes the particles as they are now to the host's sets, each to where its id lies.
  virtual void fetch(std::vector<ParticleSet>& sets) const = 0;
  /// Goes on from these particles, in place of its own.
  virtual void take(const std::vector<ParticleSet>& sets) = 0;
};

}  // namespace mpm
