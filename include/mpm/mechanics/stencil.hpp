// The nodes of a tile that one particle touches, and its weights there: a tensor product of three nodes along each axis
// around the nearest one. A shape function is a class with s[3] and g[3] made from (offset, half box, 1 / cell).
#pragma once

#include <array>

#include "mpm/grid/grid_layout.hpp"
#include "mpm/mechanics/tile.hpp"
#include "mpm/particles/particle_set.hpp"

namespace mpm {

template <int Dim, template <class> class Shape>
struct Stencil {
  double s[Dim][3];  ///< shape function along each axis
  double g[Dim][3];  ///< its gradient [1/m]
  int base;          ///< tile node of the lower corner

  /// `corner`: node numbers of the tile's lower corner.
  Stencil(const GridLayout& layout, const ParticleSet& set, const std::array<int, 3>& corner, int p) : base(0) {
    for (int k = 0; k < Dim; ++k) {
      const double cells = layout.in_cells(k, set.x[k][p]);
      const int nearest = GridLayout::nearest(cells);
      const Shape<double> shape(cells - nearest, set.half[k], layout.inverse_cell(k));
      for (int n = 0; n < 3; ++n) {
        s[k][n] = shape.s[n];
        g[k][n] = shape.g[n];
      }
      base = base * kTileEdge + (nearest - 1 - corner[k]);
    }
  }

  /// visit(first tile node of a row along the last axis, S of the row, G of the row along each axis but the last).
  template <class Visit>
  void each_row(Visit&& visit) const {
    if constexpr (Dim == 3) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          const double across[2] = {g[0][i] * s[1][j], s[0][i] * g[1][j]};
          visit(base + (i * kTileEdge + j) * kTileEdge, s[0][i] * s[1][j], across);
        }
      }
    } else {
      for (int i = 0; i < 3; ++i) {
        const double across[1] = {g[0][i]};
        visit(base + i * kTileEdge, s[0][i], across);
      }
    }
  }
};

}  // namespace mpm
