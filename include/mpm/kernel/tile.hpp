// A block's surroundings in cache: 8 nodes along each axis, the block and two nodes beyond it on each side. Copied in
// from the blocks of the grid before particles gather, added out after they scatter; the passes in between never see
// the block table. While no particle has left the block only six nodes along an axis are touched: rows outside these
// are left out.
//
// Two layouts. What is gathered lies a component at a time, a row of 8 nodes along the last axis together; what is
// scattered lies a node at a time, its components together, padded to four.
#pragma once

#include "mpm/kernel/kernels.hpp"

namespace mpm {

using mpm_kernel::BlockView;
using mpm_kernel::kTileEdge;

template <int Dim>
struct TileShape {
  static constexpr int kRows = Dim == 3 ? 64 : 8;
  static constexpr int kBlockNodes = Dim == 3 ? 64 : 16;
  static constexpr int kLoosest[2] = {1, 0}, kEnd[2] = {7, 8};

  /// visit(row of the tile, the three blocks that it runs through, its first node in each).
  template <class Visit>
  static void each_row(const BlockView& block, Visit&& visit) {
    const int first = kLoosest[block.loose], end = kEnd[block.loose];
    if constexpr (Dim == 3) {
      for (int i = first; i < end; ++i) {
        for (int j = first; j < end; ++j) {
          visit(i * kTileEdge + j, block.neighbours + (part(i) * 3 + part(j)) * 3, (within(i) * 4 + within(j)) * 4);
        }
      }
    } else {
      for (int i = first; i < end; ++i) visit(i, block.neighbours + part(i) * 3, within(i) * 4);
    }
  }

 private:
  // Along an axis a tile is two nodes of the block before, four of the block, two of the block after it.
  static constexpr int part(int node) { return (node + 2) / 4; }
  static constexpr int within(int node) { return (node + 2) % 4; }
};

/// `Fields` components to gather from, and beside each node's value the step to the next one along the last axis.
template <class T, int Dim, int Fields>
struct GatherTile {
  using Shape = TileShape<Dim>;
  struct Row {
    T value[kTileEdge];
    T step[kTileEdge];  ///< value[z + 1] - value[z]; without a meaning for the last
  };
  alignas(64) Row rows[Fields][Shape::kRows];
  T beyond[kTileEdge];  ///< read by a register that is two rows long, and not used

  /// Copies the `components` of a nodal field into the tile's components `first`, ….
  template <int Components>
  void load(const double* field, const BlockView& block, int first) {
    Shape::each_row(block, [&](int row, const int* blocks, int node) {
      for (int c = 0; c < Components; ++c) {
        const double* part[3];
        for (int b = 0; b < 3; ++b) {
          part[b] = field + (static_cast<long>(blocks[b]) * Components + c) * Shape::kBlockNodes + node;
        }
        double value[kTileEdge];
        for (int z = 0; z < 2; ++z) value[z] = part[0][z + 2];
        for (int z = 0; z < 4; ++z) value[z + 2] = part[1][z];
        for (int z = 0; z < 2; ++z) value[z + 6] = part[2][z];
        Row& to = rows[first + c][row];
        for (int z = 0; z < kTileEdge; ++z) to.value[z] = static_cast<T>(value[z]);
        for (int z = 0; z < kTileEdge; ++z) {
          to.step[z] = static_cast<T>(z + 1 < kTileEdge ? value[z + 1] - value[z] : 0.0);
        }
      }
    });
  }
};

/// Four components to scatter into.
template <class T, int Dim>
struct ScatterTile {
  using Shape = TileShape<Dim>;
  static constexpr int kWidth = 4;
  // A particle's row of three nodes is written as four: one more node, for the last row.
  alignas(64) T data[(Shape::kRows * kTileEdge + 4) * kWidth];

  void clear(const BlockView& block) {
    Shape::each_row(block, [&](int row, const int*, int) {
      __builtin_memset(data + row * kTileEdge * kWidth, 0, sizeof(T) * kTileEdge * kWidth);
    });
  }

  /// Adds the tile's components `first`, … to the `Components` of a nodal field.
  template <int Components>
  void add_to(double* field, const BlockView& block, int first) const {
    Shape::each_row(block, [&](int row, const int* blocks, int node) {
      const T* from = data + row * kTileEdge * kWidth + first;
      for (int c = 0; c < Components; ++c) {
        double* part[3];
        for (int b = 0; b < 3; ++b) {
          part[b] = field + (static_cast<long>(blocks[b]) * Components + c) * Shape::kBlockNodes + node;
        }
        if (block.loose) part[0][2] += from[c];
        part[0][3] += from[kWidth + c];
        for (int z = 0; z < 4; ++z) part[1][z] += from[(z + 2) * kWidth + c];
        part[2][0] += from[6 * kWidth + c];
        if (block.loose) part[2][1] += from[7 * kWidth + c];
      }
    });
  }
};

}  // namespace mpm
