// A processor that takes the steps of a run in memory of its own, as a graphics processor does (doc/gpu.md). The run
// keeps the clock, the limits of steps, the modules' reports and the checkpoints; its particle sets on the host are
// brought up to date only when somebody reads them. The modules of such a run act on no grid: the device asks them for
// what depends on time (rates of damping, loads, prescribed velocities) and books with them what it does in their
// place, so that accounts and checkpoints are those of a run on the processor.
//
// Three of them act on the host in every step. Contact with rigid bodies needs the host's bodies, robots and solution
// for all points of contact: the device copies the nodes near bodies, and the particles around them, into a grid of the
// host, and takes the nodes' velocities back. Sleep acts on the nodes at the border of what is asleep in the same way.
// Particles asleep are on the host alone; where some fall asleep or wake, all go there and those awake come back.
// An implicit step decides there how often the device sweeps its soil, and finds the rows of contact
// (implicit/soil_field.hpp).
#pragma once

#include <memory>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/coulomb.hpp"
#include "mpm/step/mechanics.hpp"
#include "mpm/step/modules.hpp"
#include "mpm/step/order.hpp"
#include "mpm/step/surface_loss.hpp"

namespace mpm {

/// Contact with rigid bodies, on the host, in the steps of a device.
class HostContact {
 public:
  virtual ~HostContact() = default;
  /// True if material within `radius` [m] of a world place may meet a body in this step.
  virtual bool near(const Vec3& place, double radius) const = 0;
  /// Fields for the nodes near bodies, which the device fills and no sort does.
  virtual Fields& fields() = 0;
  /// For the particles near bodies: the run's sets, with ids, groups, places, velocities, deformation gradients and
  /// `surface`, and no other numbers of particles.
  virtual std::vector<ParticleSet>& sets() = 0;
  /// Acts on both as the stages of contact do at a hook.
  virtual void act(Hook hook) = 0;
};

/// Sleep of blocks, on the host, in the steps of a device.
class HostRest {
 public:
  virtual ~HostRest() = default;
  /// Fields as particles have been sorted last on the host; Grid::at_rest names the nodes that are held.
  virtual Fields& fields() = 0;
  /// The run's sets, whose order and blocks are those of that sort.
  virtual const std::vector<ParticleSet>& sets() = 0;
  /// True if it looks at all nodes in this step, and not at those that are held alone; known once it has acted.
  virtual bool needs_all() const = 0;
  /// Acts on these fields as the stage does at a hook; at `forces_gathered` Grid::force is the sum of all forces.
  virtual void act(Hook hook) = 0;
  /// A particle has left the reach of the block that it was sorted into: the host has to sort after this step.
  virtual void particle_left() = 0;
};

/// Parts of a run that a device asks and tells, which outlive it.
struct RunModules {
  Mechanics& mechanics;
  const Modules& modules;
  HostContact* contact = nullptr;  ///< null in a scene without rigid bodies and implicit steps
  HostRest* rest = nullptr;        ///< null in a scene that does not sleep
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
  /// Sums since the last call of the wall at a face, 2 * grid axis, + 1 for the upper one: given, and taken.
  struct OfWall {
    ImpulseAccount given;
    SurfaceLoss loss;
  };
  virtual OfWall take_wall(int face) = 0;
  /// Energy that mean stresses have taken since the last call [J].
  virtual double take_averaged() = 0;
  /// Nodes that the wall at a face held in the last step; none where no step needs it of the one before.
  virtual HeldNodes held(int face) const = 0;
  /// Goes on from these; after take().
  virtual void hold(int face, const HeldNodes& nodes) = 0;
  /// Sum of mass times the way that particles were put around periodic axes since the last call [kg m].
  virtual Vec3 take_carried() = 0;
  /// Books with the modules what was done in the place of loads, damping, PIC and prescribed velocities since the last
  /// call; other modules ask for what they are to count (Module::count()).
  virtual void tell_modules() = 0;
  /// Sums over the particles of a set that are awake.
  struct Sums {
    double kinetic = 0.0, elastic = 0.0, plastic = 0.0;  ///< [J]
    double carried = 0.0;                                ///< sum of m |v| [N s]
    double min_j = 0.0;                                  ///< smallest det F
    Vec3 momentum = Vec3::Zero();                        ///< [N s]
    Vec3 place = Vec3::Zero();                           ///< sum of m x [kg m]
  };
  virtual Sums sums(int set) = 0;
  /// Numbers of the particles: none, velocities, places and velocities, or all.
  enum class Numbers { none, velocity, motion, all };
  /// Writes these of the particles as they are now to the host's sets, each to where its id lies. It has those awake
  /// (ParticleSet::asleep), which have to be the same as when it took them.
  virtual void fetch(std::vector<ParticleSet>& sets, Numbers which) = 0;
  /// Goes on from those of these particles that are awake, in place of its own.
  virtual void take(const std::vector<ParticleSet>& sets) = 0;
};

}  // namespace mpm
