// Tools for the tests of axisymmetric shape functions: value, gradient and hoop function of a ring at every node that
// it reaches, from a radial and a planar stencil, or from the points of a domain as in the kernels.
#pragma once

#include <map>

#include "mpm/kernel/domain.hpp"
#include "mpm/shape/axisymmetric.hpp"
#include "mpm/shape/axisymmetric_points.hpp"
#include "shape_check.hpp"

namespace mpm::test {

/// Value, gradient [1/m] and hoop function [1/m] at one node.
struct RingWeight {
  double s = 0.0, g[2] = {}, t = 0.0;
};
/// Weights by the node's numbers along r and z.
using RingWeights = std::map<std::array<int, 2>, RingWeight>;

/// Weights of a product of stencils; `place.f` stretches the boxes of a shape function that stretches.
template <class Shape>
RingWeights product_weights(const Place<2>& place, const AxisRules& rules = {}) {
  int nearest[2];
  double offset[2], half[2];
  for (int k = 0; k < 2; ++k) {
    const double cells = place.x[k] / place.cell[k];
    nearest[k] = nearest_node(cells);
    offset[k] = cells - nearest[k];
    half[k] = place.half[k];
    if constexpr (Shape::kStretches) {
      half[k] = Shape::half(place.f[k][k], typename Shape::Axis(half[k], 1.0 / place.cell[k]));
    }
  }
  const auto radial = Shape::radial(offset[0], static_cast<double>(nearest[0]), half[0], 1.0 / place.cell[0], rules);
  const auto along = [&] {
    const typename Shape::Axis axis(place.half[1], 1.0 / place.cell[1]);
    if constexpr (Shape::kStretches) {
      return Shape(offset[1], half[1], axis);
    } else {
      return Shape(offset[1], axis);
    }
  }();
  RingWeights weights;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      weights[{nearest[0] + i - 1, nearest[1] + j - 1}] = {
          radial.s[i] * along.s[j], {radial.g[i] * along.s[j], radial.s[i] * along.g[j]}, radial.t[i] * along.s[j]};
    }
  }
  return weights;
}

/// Weights of a domain's points, shrunk to fit as in kernel/domain.hpp.
template <template <int> class Points>
RingWeights domain_weights(const Place<2>& place, bool planar = false) {
  mpm_kernel::GridView grid{};
  mpm_kernel::SetView<double> set{};
  BlockView block{};
  double f[4];
  for (int k = 0; k < 2; ++k) {
    grid.inverse_cell[k] = 1.0 / place.cell[k];
    set.half[k] = place.half[k];
    set.x[k] = &place.x[k];
    block.corner[k] = nearest_node(place.x[k] / place.cell[k]) / 4 * 4 - mpm_kernel::kTileMargin;
    for (int c = 0; c < 2; ++c) {
      f[c * 2 + k] = place.f[c][k];
      set.domain[c * 2 + k] = &f[c * 2 + k];
    }
  }
  set.planar_functions = planar;
  Domains<double, 2, Points> domains(grid, block, set);
  domains.fill(0, 1);
  RingWeights weights;
  for (int a = 0; a < Points<2>::kPoints; ++a) {
    const CellPoint<double, 2> at = domains.point(a, 0);
    const int low[2] = {at.node / mpm_kernel::kTileEdge + block.corner[0],
                        at.node % mpm_kernel::kTileEdge + block.corner[1]};
    for (int corner = 0; corner < 4; ++corner) {
      const int up[2] = {corner & 1, corner >> 1};
      double hat = 1.0;
      for (int k = 0; k < 2; ++k) hat *= up[k] == 1 ? at.along[k] : 1.0 - at.along[k];
      RingWeight& weight = weights[{low[0] + up[0], low[1] + up[1]}];
      weight.s += domains.weight(a, 0) * hat;
      for (int k = 0; k < 2; ++k) weight.g[k] += domains.gradient(a, k, 0) * hat;
      weight.t += domains.hoop(a, 0) * hat;
    }
  }
  return weights;
}

/// Sums over the nodes of a ring, with positions along r and z [m].
struct RingSums {
  double s = 0.0, t = 0.0, r_s = 0.0, r_t = 0.0, g[2] = {}, r_g[2] = {}, z_g[2] = {}, z_s = 0.0;
  RingSums(const RingWeights& weights, const Place<2>& place) {
    for (const auto& [node, w] : weights) {
      const double r = node[0] * place.cell[0], z = node[1] * place.cell[1];
      s += w.s;
      t += w.t;
      r_s += r * w.s;
      r_t += r * w.t;
      z_s += z * w.s;
      for (int k = 0; k < 2; ++k) {
        g[k] += w.g[k];
        r_g[k] += r * w.g[k];
        z_g[k] += z * w.g[k];
      }
    }
  }
};

}  // namespace mpm::test
