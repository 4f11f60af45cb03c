// APIC with the points of a domain: the affine field of a particle, v + C (x_i - x_p), to the nodes of its points'
// cells, and C = B D^-1 from them, B = sum S v_i (x_i - x_p)^T, D = sum S (x_i - x_p) (x_i - x_p)^T, which is not
// diagonal for a sheared domain. Source: Jiang, Schroeder, Selle, Teran & Stomakhin (2015) eq. (4) to (6); method
// reference 6.6.
#pragma once

#include "mpm/kernel/point_tile.hpp"

namespace mpm {

/// A = A^-1 of a symmetric positive matrix; by cofactors.
template <class T, int Dim>
void invert_symmetric(T (&a)[Dim][Dim]) {
  if constexpr (Dim == 1) {
    a[0][0] = T(1) / a[0][0];
  } else if constexpr (Dim == 2) {
    const T scale = T(1) / (a[0][0] * a[1][1] - a[0][1] * a[0][1]), first = a[0][0];
    a[0][0] = scale * a[1][1];
    a[1][1] = scale * first;
    a[0][1] = a[1][0] = -scale * a[0][1];
  } else {
    const T xx = a[1][1] * a[2][2] - a[1][2] * a[1][2], xy = a[0][2] * a[1][2] - a[0][1] * a[2][2];
    const T xz = a[0][1] * a[1][2] - a[0][2] * a[1][1], yy = a[0][0] * a[2][2] - a[0][2] * a[0][2];
    const T yz = a[0][1] * a[0][2] - a[0][0] * a[1][2], zz = a[0][0] * a[1][1] - a[0][1] * a[0][1];
    const T scale = T(1) / (a[0][0] * xx + a[0][1] * xy + a[0][2] * xz);
    a[0][0] = scale * xx, a[1][1] = scale * yy, a[2][2] = scale * zz;
    a[0][1] = a[1][0] = scale * xy, a[0][2] = a[2][0] = scale * xz, a[1][2] = a[2][1] = scale * yz;
  }
}

/// m S (v + C (x_i - x_p)) of particle p, at place q of its chunk; `value` is m v, with m as the component after it.
template <int Dim, int Points, class Frame, class T>
void spread_affine(const Frame& frame, int q, typename PointVectors<T>::Four value, const SetView<T>& set, int p,
                   T* nodes) {
  using V = PointVectors<T>;
  typename V::Four column[Dim] = {};  // m C
  for (int c = 0; c < Dim; ++c) {
    for (int k = 0; k < Dim; ++k) column[k][c] = static_cast<T>(set.mass) * set.affine[c * Dim + k][p];
  }
  for (int a = 0; a < Points; ++a) {
    const CellPoint<T, Dim> at = frame.point(a, q);
    const T along = at.along[Dim - 1], arm = frame.arm(a, Dim - 1, q), weight = frame.weight(a);
    at.each_pair([&](int node, T of_pair, int i, int j) {
      typename V::Four base = value;
      if constexpr (Dim > 1) base += (frame.arm(a, 0, q) + static_cast<T>(i) * frame.cell(0)) * column[0];
      if constexpr (Dim > 2) base += (frame.arm(a, 1, q) + static_cast<T>(j) * frame.cell(1)) * column[1];
      const auto low = base + arm * column[Dim - 1], high = base + (arm + frame.cell(Dim - 1)) * column[Dim - 1];
      V::add(nodes + 4 * node, weight * of_pair * V::pair((T(1) - along) * low, along * high));
    });
  }
}

/// C of particle p from the tile of velocities.
template <int Dim, int Points, class Frame, class T>
void gather_affine(const Frame& frame, int q, const PointTile<T, Dim>& velocity, const SetView<T>& set, int p) {
  using V = PointVectors<T>;
  typename V::Four b[Dim] = {};  // by axis
  T d[Dim][Dim] = {};
  for (int a = 0; a < Points; ++a) {
    const CellPoint<T, Dim> at = frame.point(a, q);
    const T along = at.along[Dim - 1], arm = frame.arm(a, Dim - 1, q), weight = frame.weight(a);
    at.each_pair([&](int node, T of_pair, int i, int j) {
      const auto pair = V::load(velocity.nodes + 4 * node);
      const auto low = weight * of_pair * (T(1) - along) * V::lower(pair);
      const auto high = weight * of_pair * along * V::upper(pair);
      if constexpr (Dim > 1) b[0] += (frame.arm(a, 0, q) + static_cast<T>(i) * frame.cell(0)) * (low + high);
      if constexpr (Dim > 2) b[1] += (frame.arm(a, 1, q) + static_cast<T>(j) * frame.cell(1)) * (low + high);
      b[Dim - 1] += arm * low + (arm + frame.cell(Dim - 1)) * high;
    });
    // Of the hat functions at a point the mean place is the point, the variance f (1 - f) of a cell squared.
    T offset[Dim];
    for (int c = 0; c < Dim; ++c) {
      offset[c] = frame.arm(a, c, q) + at.along[c] * frame.cell(c);
      d[c][c] += weight * at.along[c] * (T(1) - at.along[c]) * frame.cell(c) * frame.cell(c);
    }
    for (int c = 0; c < Dim; ++c) {
      for (int k = 0; k < Dim; ++k) d[c][k] += weight * offset[c] * offset[k];
    }
  }
  invert_symmetric<T, Dim>(d);
  for (int c = 0; c < Dim; ++c) {
    for (int k = 0; k < Dim; ++k) {
      T sum = 0;
      for (int m = 0; m < Dim; ++m) sum += b[m][c] * d[m][k];
      set.affine[c * Dim + k][p] = sum;
    }
  }
}

}  // namespace mpm
