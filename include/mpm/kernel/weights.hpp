// The weights of a chunk of particles: where they are in their block's tile, the nearest node, and the shape function
// and its gradient at that node and its two neighbours along each axis. Made anew for every pass (to store them between
// passes costs more than they do), a chunk at a time into a buffer in cache: the passes then know where to look before
// they get there. A shape function is a class with s[3], which sum to 1, and g[3], which sum to 0 (gathers and scatters
// count on it), made from the offset from the nearest node and an Axis, its constants for a body (shape/ugimp.hpp).
#pragma once

#include "mpm/kernel/tile.hpp"
#include "mpm/kernel/wide_math.hpp"

namespace mpm {

using mpm_kernel::GridView;
using mpm_kernel::SetView;

constexpr int kChunk = 64;            ///< particles at a time
constexpr int kBuffer = kChunk + 16;  ///< and what the last register writes beyond them

/// Lanes that share a row of nodes along the last axis are gathered together; else those that share their nearest node.
template <class T>
constexpr bool kByColumn = Wide<T>::kLanes >= kTileEdge;

/// What the weights of a body's particles depend on beside their places.
template <class T, int Dim, template <class> class Shape>
class WeightFrame {
  using W = Wide<T>;

 public:
  using Axis = typename Shape<W>::Axis;
  WeightFrame(const GridView& grid, const BlockView& block, const SetView<T>& set)
      : lowest_(lowest_nearest(block.loose)), highest_(highest_nearest(block.loose)) {
    for (int k = 0; k < Dim; ++k) {
      x_[k] = set.x[k];
      origin_[k] = grid.origin[k];
      inverse_cell_[k] = grid.inverse_cell[k];
      corner_[k] = block.corner[k];
      half_[k] = set.half[k];
    }
  }
  Axis axis(int k) const { return Axis(half_[k], inverse_cell_[k]); }
  /// Of particles [p, p + count) along axis k, in the tile: its node i lies at i.
  W cells(int k, int p, int count) const {
    return W(W::B::place(x_[k] + p, count, origin_[k], inverse_cell_[k], corner_[k]));
  }
  /// Half way between two nodes the upper one, as the sorter has it; and none that the tile does not hold.
  W nearest(W cells) const { return max(min(round(cells + W(kTie)), highest_), lowest_); }

 private:
  static constexpr double kTie = sizeof(T) == 8 ? 1e-12 : 2e-6;  // beyond the round-off of a place in the tile
  const double* x_[Dim];
  double origin_[Dim], inverse_cell_[Dim], corner_[Dim], half_[Dim];
  W lowest_, highest_;
};

template <class T, int Dim, template <class> class Shape>
struct Weights {
  using W = Wide<T>;
  static constexpr int kLast = Dim - 1;

  alignas(64) T s[Dim][3][kBuffer];   ///< shape function along each axis
  alignas(64) T g[Dim][3][kBuffer];   ///< its gradient [1/m]
  alignas(64) T cells[Dim][kBuffer];  ///< place in the tile
  alignas(64) T last[kBuffer];        ///< nearest node along the last axis
  alignas(64) T place[kBuffer];       ///< what lanes must share to be gathered together: number of a column or a node
  alignas(64) int node[kBuffer];      ///< number in the tile of the nearest node

  /// Of particles [first, first + count); what follows them in the buffer has no meaning. Gradients: g too.
  template <bool Gradients>
  void fill(const WeightFrame<T, Dim, Shape>& frame, int first, int count) {
    for (int k = 0; k < Dim; ++k) {
      const typename Shape<W>::Axis axis = frame.axis(k);
      for (int q = 0; q < count; q += W::kLanes) {
        const W x = frame.cells(k, first + q, count - q);
        const W nearest = frame.nearest(x);
        const Shape<W> shape(x - nearest, axis);
        for (int n = 0; n < 3; ++n) {
          shape.s[n].store(s[k][n] + q);
          if constexpr (Gradients) shape.g[n].store(g[k][n] + q);
        }
        x.store(cells[k] + q);
        const W number = k == 0 ? nearest : W::load(place + q) * W(kTileEdge) + nearest;
        if (k < kLast || !kByColumn<T>) number.store(place + q);
        if (k == kLast) {
          nearest.store(last + q);
          typedef int Numbers __attribute__((vector_size(4 * W::kLanes)));
          const Numbers numbers = __builtin_convertvector(number.v, Numbers);
          __builtin_memcpy(node + q, &numbers, sizeof(numbers));
        }
      }
    }
  }
};

}  // namespace mpm
