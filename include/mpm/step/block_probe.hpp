// Forces of the particles of one block on the grid, and the speed of waves across a cell in some of them: asked for a
// few particles at a time, beside the passes of a step.
#pragma once

#include <array>

namespace mpm {

/// Forces that the particles of a block give to the nodes of its tile: 8 nodes along each axis, the last axis fastest,
/// the first node two before the block's own first.
struct BlockForces {
  static constexpr int kEdge = 8, kMargin = 2;
  static constexpr int kMostNodes = kEdge * kEdge * kEdge;

  std::array<float, kMostNodes> mass{};                  ///< [kg]
  std::array<std::array<float, kMostNodes>, 3> force{};  ///< internal, along the grid's axes [N]

  void add(const BlockForces& other) {
    for (int t = 0; t < kMostNodes; ++t) {
      mass[t] += other.mass[t];
      for (int k = 0; k < 3; ++k) force[k][t] += other.force[k][t];
    }
  }
};

class BlockProbe {
 public:
  virtual ~BlockProbe() = default;
  /// Finds the forces of an owner of a velocity field (numbered in the field), in the present state. Particles have to
  /// be sorted.
  virtual void find_forces(int field, int owner, BlockForces& result) = 0;
  /// By which waves, motion and viscosity cross a cell in particles [first, last) of a set [1/s]. `cell`: the smallest
  /// edge [m].
  virtual double fastest(int set, int first, int last, double cell) = 0;
};

}  // namespace mpm
