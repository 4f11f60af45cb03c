// APIC with the points of a domain: a particle keeps B = sum S v_i (x_i - x_p)^T and gives the nodes of its points'
// cells the affine field v + B D^-1 (x_i - x_p), D = sum S (x_i - x_p) (x_i - x_p)^T, which is not diagonal for a
// sheared domain. B is kept and not its gradient B D^-1: D changes as the particle moves on, and angular momentum is
// that of B. Source: Jiang, Schroeder, Selle, Teran & Stomakhin (2015) eq. (4) to (6); method reference 6.6.
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

/// D of the particle at place q of its chunk, lengths in cells: in metres its determinant could be too small a number
/// for single precision.
template <int Dim, int Points, class Frame, class T>
void second_moment(const Frame& frame, int q, T (&d)[Dim][Dim]) {
  for (auto& row : d) {
    for (T& component : row) component = T(0);
  }
  for (int a = 0; a < Points; ++a) {
    const CellPoint<T, Dim> at = frame.point(a, q);
    const T weight = frame.weight(a, q);
    // Hat functions at a point have the point as mean place and the variance f (1 - f) of a cell squared.
    T offset[Dim];
    for (int c = 0; c < Dim; ++c) {
      offset[c] = frame.arm(a, c, q) / frame.cell(c) + at.along[c];
      d[c][c] += weight * at.along[c] * (T(1) - at.along[c]);
    }
    for (int c = 0; c < Dim; ++c) {
      for (int k = 0; k < Dim; ++k) d[c][k] += weight * offset[c] * offset[k];
    }
  }
}

/// m S (v + B D^-1 (x_i - x_p)) of particle p, at place q of its chunk; `value` is m v, with m as the component after
/// it.
template <int Dim, int Points, class Frame, class T>
void spread_affine(const Frame& frame, int q, typename PointVectors<T>::Four value, const SetView<T>& set, int p,
                   T* nodes) {
  using V = PointVectors<T>;
  T inverse[Dim][Dim];
  second_moment<Dim, Points>(frame, q, inverse);
  invert_symmetric<T, Dim>(inverse);
  const T mass = value[Dim];
  typename V::Four column[Dim] = {};  // m B D^-1
  for (int k = 0; k < Dim; ++k) {
    for (int c = 0; c < Dim; ++c) {
      T sum = 0;
      for (int m = 0; m < Dim; ++m) sum += set.affine[c * Dim + m][p] / frame.cell(m) * inverse[m][k];
      column[k][c] = mass * sum / frame.cell(k);
    }
  }
  for (int a = 0; a < Points; ++a) {
    const CellPoint<T, Dim> at = frame.point(a, q);
    const T along = at.along[Dim - 1], arm = frame.arm(a, Dim - 1, q), weight = frame.weight(a, q);
    at.each_pair([&](int node, T of_pair, int i, int j) {
      typename V::Four base = value;
      if constexpr (Dim > 1) base += (frame.arm(a, 0, q) + static_cast<T>(i) * frame.cell(0)) * column[0];
      if constexpr (Dim > 2) base += (frame.arm(a, 1, q) + static_cast<T>(j) * frame.cell(1)) * column[1];
      const auto low = base + arm * column[Dim - 1], high = base + (arm + frame.cell(Dim - 1)) * column[Dim - 1];
      V::add(nodes + 4 * node, weight * of_pair * V::pair((T(1) - along) * low, along * high));
    });
  }
}

/// B of particle p from the tile of velocities.
template <int Dim, int Points, class Frame, class T>
void gather_affine(const Frame& frame, int q, const PointTile<T, Dim>& velocity, const SetView<T>& set, int p) {
  using V = PointVectors<T>;
  typename V::Four b[Dim] = {};  // by axis
  for (int a = 0; a < Points; ++a) {
    const CellPoint<T, Dim> at = frame.point(a, q);
    const T along = at.along[Dim - 1], arm = frame.arm(a, Dim - 1, q), weight = frame.weight(a, q);
    at.each_pair([&](int node, T of_pair, int i, int j) {
      const auto pair = V::load(velocity.nodes + 4 * node);
      const auto low = weight * of_pair * (T(1) - along) * V::lower(pair);
      const auto high = weight * of_pair * along * V::upper(pair);
      if constexpr (Dim > 1) b[0] += (frame.arm(a, 0, q) + static_cast<T>(i) * frame.cell(0)) * (low + high);
      if constexpr (Dim > 2) b[1] += (frame.arm(a, 1, q) + static_cast<T>(j) * frame.cell(1)) * (low + high);
      b[Dim - 1] += arm * low + (arm + frame.cell(Dim - 1)) * high;
    });
  }
  for (int c = 0; c < Dim; ++c) {
    for (int k = 0; k < Dim; ++k) set.affine[c * Dim + k][p] = b[k][c];
  }
}

}  // namespace mpm
