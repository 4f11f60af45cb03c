// Dirac: the hat function at the particle's centre, the classic MPM. The cheapest, two nodes along each axis. Weak: the
// gradient jumps where a particle crosses into the next cell, and so does the force (cell-crossing noise); it does not
// converge once particles cross cells. Source: Sulsky, Chen & Schreyer (1994); GIMP notes (1.21), (1.23) for a particle
// that is a point; method reference 2.3.
#pragma once

#include "mpm/math/lanes.hpp"
#include "mpm/shape/traits.hpp"

namespace mpm {

/// Values and gradients at the three nodes nearest-1, nearest, nearest+1; those of one outer node are 0.
template <class T>
struct Dirac : ShapeDefaults {
  static constexpr int kNodes = 3;
  static constexpr ShapeKind kKind = ShapeKind::dirac;
  static constexpr const char *kName = "dirac", *kOtherName = "classic";
  static constexpr int kDegree = 1;
  static constexpr Follows kFollows = Follows::nothing;
  static constexpr int kMostNodes = 2;

  struct Axis {
    T inverse_cell;
    /// The first argument, the half-width of the box, is not used. `per_cell` [1/m].
    Axis(double, double per_cell) : inverse_cell(per_cell) {}
    explicit Axis(T per_cell) : inverse_cell(per_cell) {}
  };

  T s[3];  ///< shape function, sums to 1
  T g[3];  ///< gradient [1/m], sums to 0; for a particle on a node that of the cell above

  /// `offset`: particle minus its nearest node, in cells, in [-1/2, 1/2].
  Dirac(T offset, const Axis& axis) {
    s[0] = max(-offset, T(0));
    s[2] = max(offset, T(0));
    s[1] = T(1) - s[0] - s[2];
    const auto in_cell_below = offset < T(0);
    g[0] = select(in_cell_below, -axis.inverse_cell, T(0));
    g[2] = select(in_cell_below, T(0), axis.inverse_cell);
    g[1] = -g[0] - g[2];
  }
};

}  // namespace mpm
