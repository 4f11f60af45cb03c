// The cells of the implicit step: what particles give to them, the unknown stresses that sweeps find, and what
// particles take from these. About an axis a cell is the section of a ring, with volumes and momentum of the whole
// turn.
//
// A particle's box is cut by the cells' faces into up to eight pieces. Over a piece the hat functions of the cell's
// nodes are products of straight lines, whose means are their values at its middle: so the sums over pieces of volume
// and of products of their middles' coordinates (seven numbers) give the mean gradients B of uGIMP exactly, and the
// stress of a particle in a step is the mean over its pieces of the cells' stresses. Cells with one stress do not lock,
// and pressures that alternate from cell to cell have no place in them (doc/implicit.md).
//
// Of each soil a cell has a stress of its own. Deformation, stress and history of particles are what the explicit laws
// have (material/drucker_prager.hpp): F, the Kirchhoff stress over initial density, plastic strain, opening and plastic
// work. The opening may be negative here: soil that few sweeps have left too dense, which gives back a fifth of it in a
// step.
//
// Weak: stress is that of cells, without variation inside them, so that it spreads by up to a cell where material moves
// through the grid. What a sweep leaves undone is an error of volume or strength, of which the particles remember the
// volume alone. Source: Daviet & Bertails-Descoubes (2016) for one stress in a cell; the moments are those of a
// trilinear element.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/implicit/held_impulses.hpp"
#include "mpm/implicit/soil_grid.hpp"
#include "mpm/implicit/soil_law.hpp"
#include "mpm/kernel/soil_cells.hpp"
#include "mpm/particles/particle_set.hpp"

namespace mpm {

/// Bodies of soil, and the soils of which they are.
struct SoilBodies {
  struct Body {
    ParticleSet* set;
    int soil;  ///< number of its soil
  };
  std::vector<Body> list;
  std::vector<ImplicitSoil> soils;
};

/// Tells what a soil's particles give to cells and take from them; where they are is left open.
template <class T>
void describe(const ImplicitSoil& soil, mpm_kernel::SoilParticles<T>& particles) {
  particles.density = soil.density;
  particles.bulk = soil.bulk;
  particles.shear = soil.shear;
  particles.per_strain = soil.per_strain;
  particles.strain_of_shear = soil.strain_of_shear;
  particles.dilation_start = soil.dilation_start;
  particles.dilation_slope = soil.dilation_slope;
}

/// T: precision of the sweeps, that of the particles.
template <class T>
class SoilCells {
 public:
  using Group = mpm_kernel::SoilGroup<T>;
  using Node = mpm_kernel::SoilNode<T>;

  /// Bodies, their sets and the grid outlive this.
  SoilCells(const SoilBodies& bodies, const SoilGrid& grid, int threads);

  /// After the blocks in use have changed.
  void rebuild();
  /// Finds the cells from the particles, with the stress that they have as the one to begin with. `nodes`: of
  /// SoilGrid::numbers(), with inverse masses.
  void gather(const mpm_kernel::SweepTable<T>& table, const std::vector<Node>& nodes, double dt);
  /// Gives the particles the strain of the step, and the stresses that were found.
  void take(const mpm_kernel::SweepTable<T>& table, const std::vector<Node>& nodes, double dt);

  /// The groups of cells in a block.
  int count(int block) const { return begin_[block + 1] - begin_[block]; }
  Group* groups(int block) { return groups_.data() + begin_[block]; }
  const mpm_kernel::SoilMask<T>* masks() const { return masks_.data(); }

  /// Adds what stresses give to the components of velocity that are held.
  void add_to_held(HeldImpulses& held) const;
  /// Sum all the way round of what hoop stresses give along r [N s].
  double of_hoops() const;

 private:
  using Sums = mpm_kernel::SoilSums<T>;
  using Motion = mpm_kernel::SoilMotion<T>;
  /// The particles of a body, as they lie now.
  mpm_kernel::SoilParticles<T> view_of(int body) const;
  /// pass(first, last, corner, places) for the particles of a body in an owner's block.
  template <class Pass>
  void each_owner(int body, int owner, Pass&& pass);
  void make_groups(const mpm_kernel::SweepTable<T>& table, const std::vector<Node>& nodes, double dt, int block);
  void make_cell(const Sums& sums, int soil, int block, const std::array<int, 3>& local, double dt, int group, int lane,
                 mpm_kernel::SoilPlaces<T>& places);
  void find_motion(const mpm_kernel::SweepTable<T>& table, const std::vector<Node>& nodes, int group);
  /// The place of a soil's first cell in a block, or -1.
  int& slot(int soil, int block) { return slots_[static_cast<std::size_t>(soil) * blocks_ + block]; }

  const SoilBodies& bodies_;
  std::vector<mpm_kernel::SoilConstants> constants_;  ///< constants of each soil
  std::vector<mpm_kernel::SoilParticles<T>> views_;   ///< in this step
  const SoilGrid& grid_;
  int threads_;
  int blocks_ = 0;
  std::vector<int> slots_;
  std::vector<Sums> sums_;      ///< sums of each place
  std::vector<Motion> motion_;  ///< motion of each place
  std::vector<int> begin_;      ///< first group of each block
  std::vector<Group> groups_;
  std::vector<mpm_kernel::SoilMask<T>> masks_;  ///< mask of each group
};

}  // namespace mpm
