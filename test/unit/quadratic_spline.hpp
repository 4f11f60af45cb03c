// Quadratic B-splines: three nodes along each axis, smooth, and blind to the particle's box. Here to show that a shape
// function needs nothing but a class. Source: Steffen, Kirby & Berzins (2008) eq. (12), inside the grid.
#pragma once

namespace mpm {

/// Values and gradients at the three nodes nearest-1, nearest, nearest+1.
template <class T>
struct QuadraticSpline {
  struct Axis {
    T inverse_cell;
    Axis(double, double per_cell) : inverse_cell(per_cell) {}
  };

  T s[3];
  T g[3];  ///< [1/m]

  /// `offset`: particle minus its nearest node, in cells, in [-1/2, 1/2].
  QuadraticSpline(T offset, const Axis& axis) {
    const T below = T(0.5) - offset, above = T(0.5) + offset;
    s[0] = T(0.5) * below * below;
    s[1] = T(0.75) - offset * offset;
    s[2] = T(0.5) * above * above;
    g[0] = -below * axis.inverse_cell;
    g[1] = T(-2) * offset * axis.inverse_cell;
    g[2] = above * axis.inverse_cell;
  }
};

}  // namespace mpm
