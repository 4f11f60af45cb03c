// The weights of a register of particles: where they are in their block's tile, the nearest node, and the shape
// function and its gradient at that node and its two neighbours along each axis. A shape function is a class with s[3]
// and g[3] made from (offset from the nearest node, half box, 1 / cell).
#pragma once

#include "mpm/kernel/tile.hpp"
#include "mpm/kernel/wide_math.hpp"

namespace mpm {

using mpm_kernel::GridView;
using mpm_kernel::SetView;

template <class T, int Dim, template <class> class Shape>
struct Weights {
  using W = Wide<T>;
  static constexpr int kLast = Dim - 1;
  W cells[Dim];    ///< place in the tile: its node i lies at i
  W nearest[Dim];  ///< the nearest node
  W s[Dim][3];     ///< shape function along each axis
  W g[Dim][3];     ///< its gradient [1/m]

  /// Of particles [p, p + count). Lanes beyond `count` hold numbers without a meaning.
  Weights(const GridView& grid, const BlockView& block, const SetView<T>& set, int p, int count) {
    for (int k = 0; k < Dim; ++k) {
      cells[k] = W(W::B::place(set.x[k] + p, count, grid.origin[k], grid.inverse_cell[k], block.corner[k]));
      // Half way between two nodes either will do, and rounding must not choose one that the tile does not hold.
      nearest[k] = max(min(round(cells[k]), W(block.loose ? kTileEdge - 2 : kTileEdge - 3)), W(block.loose ? 1 : 2));
      const Shape<W> shape(cells[k] - nearest[k], W(set.half[k]), W(grid.inverse_cell[k]));
      for (int n = 0; n < 3; ++n) {
        s[k][n] = shape.s[n];
        g[k][n] = shape.g[n];
      }
    }
  }

  /// Number of the row of nodes along the last axis in which the nearest node lies.
  W row() const {
    if constexpr (Dim == 3) return nearest[0] * W(kTileEdge) + nearest[1];
    return nearest[0];
  }
  /// Number of the nearest node in the tile.
  W node() const { return row() * W(kTileEdge) + nearest[Dim - 1]; }
};

}  // namespace mpm
