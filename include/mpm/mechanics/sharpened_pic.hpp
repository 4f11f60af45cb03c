// PIC of order 2: what a part of PIC smooths is undone once, by a step on the nodes.
//
// Particles that take the part 1 - flip of the grid's velocity lose in a step that part of v - S+ S v, which smooths
// all motion, also what the grid resolves. XPIC(2) takes 2 S+ S v - (S+ S)^2 v in place of S+ S v (method
// reference 6.6) by two more passes over all particles. Here S+ S v - v is estimated on the nodes, where particles at
// rest in their cells make it a difference between neighbours, c sum_j (v_j - v_i), with c half the sum over particles
// of the second moments of the shape function: 1/6 + 1/(12 n^2) of the linear ones with n particles along an edge of a
// cell, exact on a line; 1/4 and 1/3 of the quadratic and the cubic B-spline. The step gives every node
//
//   dv_i = -(1 - flip) c sum_j min(1, m_j/m_i) (v_j - v_i),   j the neighbours along the axes,
//
// so a wave that lost (1 - flip) c l of its amplitude in a step loses (1 - flip) (c l)^2, l = 2 (1 - cos k h). The sum
// of m_i dv_i is zero. It is an increment as those of XPIC are: conditions hold the velocities that it is found from,
// and take from it what they hold (step/stage.hpp). At a mirror a node has the half of its mass, and the neighbour
// beyond it is the one before it.
//
// Weak: across the diagonals of a cell the product of two smoothings is left out; where particles have moved together
// or apart, c is that of those at rest; nodes on the two sides of a crack are neighbours as any others.
// Source: derived for this project from XPIC, Hammerquist & Nairn (2017); doc/method_keys.md has what it does.
#pragma once

#include <vector>

#include "mpm/ranks/halo.hpp"
#include "mpm/shape/kind.hpp"
#include "mpm/step/chunk_sums.hpp"

namespace mpm {

/// c above. `particles_per_direction`: along an edge of a cell.
double smoothing_of(ShapeKind shape, int particles_per_direction);

class SharpenedPic {
 public:
  /// `part`: (1 - flip) c. `fields` and `halo`, which is null on one process, outlive it.
  SharpenedPic(double part, Fields& fields, int threads, Halo* halo);

  /// Replaces Grid::increment, v of the step's start as conditions hold it, by dv [m/s].
  void find();
  /// Adds Grid::increment to Grid::velocity and what it is in a time to the acceleration, Grid::force. Returns the work
  /// done so [J], on this rank.
  double add(double dt);

 private:
  /// The work on a velocity field.
  struct OfField {
    OfField(const GridLayout& layout) : change(layout.dim(), layout.nodes_per_block()) {}
    NodalField change;             ///< dv [m/s]
    std::vector<int> beside;       ///< of every block, the blocks before and after it along each axis, or -1
    std::vector<Halo::Nodes> own;  ///< of every block, nodes whose change this rank finds; empty on one process
    std::uint64_t generation = 0;  ///< of the blocks that these were found for
  };

  void follow_sort(int field);
  void find_change(const Grid& grid, OfField& work, int block) const;

  double part_;
  Fields& fields_;
  int threads_;
  Halo* halo_;
  std::vector<OfField> work_;
  ChunkSums<double> sums_;
};

}  // namespace mpm
