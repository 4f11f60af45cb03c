// Soil as the solve of an implicit step moves it: nodes, cells and particles, in the memory of this processor
// (src/mpm/implicit/host_field.hpp) or of a device. The solve (implicit_step.hpp) decides how often it is swept and
// what is booked; rows of contact are found on the host, with its nodes.
//
// A step: begin(), take_rows(), then meet(), go_on() and sweep() as the solve asks for them, end_sweeps(), finish().
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/implicit/held_impulses.hpp"
#include "mpm/kernel/soil_cells.hpp"
#include "mpm/math/geometry.hpp"

namespace mpm {

/// Result of a step beside moving the soil.
struct SoilDeeds {
  HeldImpulses::OfWalls held{};  ///< given by walls that hold nodes, less what cells and rows gave these [N s]
  Vec3 light = Vec3::Zero();     ///< impulse that light nodes were not given [N s]
  double taken = 0.0;            ///< by the step itself [J]
};

/// T: precision of the sweeps, that of the particles.
template <class T>
class SoilField {
 public:
  using Node = mpm_kernel::SoilNode<T>;

  virtual ~SoilField() = default;

  /// A step of `dt` [s] begins: nodes have their velocities with gravity and loads, cells are found from the particles
  /// and have given nodes the impulses of the stresses with which they begin. `other_blocks`: other blocks are in use
  /// than in the step before.
  virtual void begin(double dt, bool other_blocks) = 0;
  /// The nodes on the host, by SoilGrid::numbers(): of all of them between begin() and take_rows() and after
  /// end_sweeps(), and of those shown in between.
  virtual std::vector<Node>& nodes() = 0;
  /// Goes on with nodes() and with the rows of contact as the host has them.
  virtual void take_rows() = 0;
  /// Solves all contacts but those of free bodies once, and brings the rows of tools on the host up to date.
  virtual void meet() = 0;
  /// Shows the host the nodes around free bodies, and takes them back as it has left them.
  virtual void show() = 0;
  virtual void take_back() = 0;
  /// Before a pair of sweeps: all unknowns but those of free bodies go on (sweep_momentum.hpp).
  virtual void go_on(T factor) = 0;
  /// Sweeps the cells of the blocks with a mark, and writes their changes.
  virtual void sweep(bool backwards, const std::vector<std::uint8_t>& marked,
                     std::vector<mpm_kernel::SweepChange>& changes) = 0;
  /// Brings nodes() and all rows on the host up to date.
  virtual void end_sweeps() = 0;
  /// Adds what stresses give to the components of velocity that are held.
  virtual void add_to_held(HeldImpulses& held) = 0;
  /// Gives particles strain and stress, and the grid the velocities that were found; adds what it does beside this.
  virtual void finish(double dt, SoilDeeds& deeds) = 0;
  /// Sum all the way round of what hoop stresses give along r in this step [N s].
  virtual double of_hoops() const = 0;
  /// Puts particles that lie in a body on its surface, after the bodies have moved. Returns true if particles have to
  /// be sorted.
  virtual bool put_out() = 0;
};

}  // namespace mpm
