// Shape functions along one axis, in cells, implemented once more for the theory of the atlas, independently of the
// solver. In the plane they are multiplied; particles are undeformed. Source: method reference 2.1 (uGIMP), 2.3
// (Dirac), 2.4 (splines), 2.6 and 2.7 (CPDI, qCPDI of an upright box).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "mpm/shape/kind.hpp"

namespace stability {

/// Value and gradient at a node, for a particle at distance `s` = particle - node; `half`: half-width of the particle's
/// box.
inline std::array<double, 2> axis_weight(mpm::ShapeKind shape, double s, double half) {
  const auto hat = [](double x) { return std::max(0.0, 1.0 - std::abs(x)); };
  const auto integral = [](double x) {  // integral of the hat from -1
    const double c = std::clamp(x, -1.0, 1.0);
    return c < 0.0 ? 0.5 * (1.0 + c) * (1.0 + c) : 0.5 + c - 0.5 * c * c;
  };
  const double a = std::abs(s), sign = s < 0.0 ? -1.0 : 1.0;
  const double between = (hat(s + half) - hat(s - half)) / (2.0 * half);
  switch (shape) {
    case mpm::ShapeKind::dirac:
      return {hat(s), a < 1.0 ? -sign : 0.0};
    case mpm::ShapeKind::ugimp:
    case mpm::ShapeKind::ugimp_stretch:
      return {(integral(s + half) - integral(s - half)) / (2.0 * half), between};
    case mpm::ShapeKind::cpdi:
      return {0.5 * (hat(s - half) + hat(s + half)), between};
    case mpm::ShapeKind::qcpdi:
      return {(hat(s - half) + 4.0 * hat(s) + hat(s + half)) / 6.0, between};
    case mpm::ShapeKind::bspline2:
      if (a < 0.5) return {0.75 - s * s, -2.0 * s};
      return a < 1.5 ? std::array{0.5 * (1.5 - a) * (1.5 - a), -sign * (1.5 - a)} : std::array{0.0, 0.0};
    case mpm::ShapeKind::bspline3:
      if (a < 1.0) return {2.0 / 3.0 - s * s + 0.5 * a * s * s, sign * (-2.0 * a + 1.5 * s * s)};
      return a < 2.0 ? std::array{(2.0 - a) * (2.0 - a) * (2.0 - a) / 6.0, -0.5 * sign * (2.0 - a) * (2.0 - a)}
                     : std::array{0.0, 0.0};
  }
  throw std::invalid_argument("no such shape function");
}

/// Value and gradient at node number `node` for a particle at `place`, between walls at the nodes `low` and `high`: the
/// weight of a spline beyond a wall is folded onto the two nodes inside (shape/bspline.hpp).
inline std::array<double, 2> walled_weight(mpm::ShapeKind shape, double place, double node, double half, double low,
                                           double high) {
  if (node < low || node > high) return {0.0, 0.0};
  std::array<double, 2> sum = axis_weight(shape, place - node, half);
  if (shape != mpm::ShapeKind::bspline2 && shape != mpm::ShapeKind::bspline3) return sum;
  const auto add = [&](double factor, double beyond) {
    const std::array<double, 2> weight = axis_weight(shape, place - beyond, half);
    for (int i = 0; i < 2; ++i) sum[i] += factor * weight[i];
  };
  for (const auto& [wall, inward] : {std::array{low, 1.0}, std::array{high, -1.0}}) {
    if (node == wall) {
      add(2.0, wall - inward);
      add(3.0, wall - 2.0 * inward);
    } else if (node == wall + inward) {
      add(-1.0, wall - inward);
      add(-2.0, wall - 2.0 * inward);
    }
  }
  return sum;
}

}  // namespace stability
