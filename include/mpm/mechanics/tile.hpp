// A block's surroundings in cache: 8 nodes along each axis, the block and two nodes beyond it on each side, all
// components of a node together. Copied in from the blocks of the grid before a block's particles gather, added out
// after they scatter; the passes in between never see the block table.
#pragma once

#include <algorithm>

#include "mpm/grid/block_table.hpp"
#include "mpm/grid/nodal_fields.hpp"

namespace mpm {

inline constexpr int kTileEdge = 8;
inline constexpr int kTileMargin = 2;

template <int Dim, int Components>
struct Tile {
  static constexpr int kNodes = Dim == 3 ? 512 : 64;
  static constexpr int kSpan = Dim == 3 ? 27 : 9;

  alignas(64) double data[kNodes][Components];

  void clear() { std::fill_n(&data[0][0], kNodes * Components, 0.0); }

  /// Copies all components of `field` into components `first`, `first + 1`, ….
  void load(const NodalField& field, const int* neighbours, int first) {
    each_part(neighbours, [&](int block, int tile_node, int node, int count) {
      for (int c = 0; c < field.components(); ++c) {
        const double* from = field.block(block) + c * kBlockNodes + node;
        for (int n = 0; n < count; ++n) data[tile_node + n][first + c] = from[n];
      }
    });
  }

  /// Adds components `first`, `first + 1`, … to all components of `field`.
  void add_to(NodalField& field, const int* neighbours, int first) const {
    each_part(neighbours, [&](int block, int tile_node, int node, int count) {
      for (int c = 0; c < field.components(); ++c) {
        double* to = field.block(block) + c * kBlockNodes + node;
        for (int n = 0; n < count; ++n) to[n] += data[tile_node + n][first + c];
      }
    });
  }

 private:
  static constexpr int kBlockNodes = Dim == 3 ? 64 : 16;

  // Along one axis the tile is two nodes of the neighbour below, four of the block, two of the neighbour above.
  static constexpr int kTileBegin[3] = {0, 2, 6};
  static constexpr int kBlockBegin[3] = {2, 0, 0};
  static constexpr int kCount[3] = {2, 4, 2};

  // visit(block, first tile node, first node of the block, count) for every run of nodes along the last axis.
  template <class Visit>
  static void each_part(const int* neighbours, Visit&& visit) {
    for (int s = 0; s < kSpan; ++s) {
      const int block = neighbours[s];
      const int sx = Dim == 3 ? s / 9 : 1, sy = (s / 3) % 3, sz = s % 3;
      const int x_count = Dim == 3 ? kCount[sx] : 1;
      for (int i = 0; i < x_count; ++i) {
        for (int j = 0; j < kCount[sy]; ++j) {
          int tile_row = kTileBegin[sy] + j, block_row = kBlockBegin[sy] + j;
          if constexpr (Dim == 3) {
            tile_row += kTileEdge * (kTileBegin[sx] + i);
            block_row += kBlockEdge * (kBlockBegin[sx] + i);
          }
          visit(block, tile_row * kTileEdge + kTileBegin[sz], block_row * kBlockEdge + kBlockBegin[sz], kCount[sz]);
        }
      }
    }
  }
};

}  // namespace mpm
