// Forces of the particles of one block on the grid, and the speed of waves across a cell in some of them: asked for a
// few particles at a time, beside the passes of a step.
#pragma once

#include <array>

#include "mpm/grid/grid_layout.hpp"

namespace mpm {

/// Forces that the particles of a block give to the nodes of its tile: 8 nodes along each axis, the last axis fastest,
/// the first node two before the block's own first.
struct BlockForces {
  static constexpr int kEdge = 8, kMargin = 2;
  static constexpr int kMostNodes = kEdge * kEdge * kEdge;

  std::array<float, kMostNodes> mass{};                  ///< [kg]
  std::array<std::array<float, kMostNodes>, 3> force{};  ///< internal, along the grid's axes [N]
  /// Sum of m S times the particles' mean stress over the initial density, where volume changes are averaged over the
  /// grid [J].
  std::array<float, kMostNodes> stress{};

  void add(const BlockForces& other) {
    for (int t = 0; t < kMostNodes; ++t) {
      mass[t] += other.mass[t];
      stress[t] += other.stress[t];
      for (int k = 0; k < 3; ++k) force[k][t] += other.force[k][t];
    }
  }
};

/// visit(number in the tile, block of the 3^dim around, node in it) for the nodes of a block's tile.
template <class Visit>
void each_tile_node(int dim, Visit&& visit) {
  int tile_nodes = 1;
  for (int k = 0; k < dim; ++k) tile_nodes *= BlockForces::kEdge;
  for (int t = 0; t < tile_nodes; ++t) {
    int rest = t, block = 0, node = 0, block_stride = 1, node_stride = 1;
    for (int k = dim - 1; k >= 0; --k) {
      const int at = rest % BlockForces::kEdge - BlockForces::kMargin + kBlockEdge;  // from the first block's first
      block += at / kBlockEdge * block_stride;
      node += at % kBlockEdge * node_stride;
      rest /= BlockForces::kEdge;
      block_stride *= 3;
      node_stride *= kBlockEdge;
    }
    visit(t, block, node);
  }
}

class BlockProbe {
 public:
  virtual ~BlockProbe() = default;
  /// To be called before forces of blocks are found: finds the means that their stresses take part in, where volume
  /// changes are averaged over the grid.
  virtual void find_means() {}
  /// Finds the forces of an owner of a velocity field (numbered in the field), in the present state. Particles have to
  /// be sorted.
  virtual void find_forces(int field, int owner, BlockForces& result) = 0;
  /// By which waves, motion and viscosity cross a cell in particles [first, last) of a set [1/s]. `cell`: the smallest
  /// edge [m].
  virtual double fastest(int set, int first, int last, double cell) = 0;
};

}  // namespace mpm
