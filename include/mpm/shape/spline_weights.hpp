// Weights of a spline at a point, along one axis, for what lies outside the kernels: points of surfaces, faces.
#pragma once

#include <array>
#include <cmath>

#include "mpm/grid/grid_layout.hpp"
#include "mpm/shape/bspline.hpp"

namespace mpm {

constexpr double kFarWall = 1e9;  ///< number of the node of a wall that there is not

/// Weights of the nodes first, first + 1, …
struct AxisWeights {
  int first = 0, count = 0;
  std::array<double, 5> weight{};
};

/// Number of weights of the spline of a degree.
constexpr int weights_of_spline(int degree) { return degree == 3 ? 5 : degree + 1; }

template <class Spline>
AxisWeights folded_weights(double cells, double low, double high) {
  const int nearest = GridLayout::nearest(cells);
  Spline spline(cells - nearest, typename Spline::Axis(0.0, 1.0));
  spline.fold(nearest - low, high - nearest);
  AxisWeights weights{nearest - Spline::kNodes / 2, Spline::kNodes, {}};
  for (int n = 0; n < Spline::kNodes; ++n) weights.weight[n] = spline.s[n];
  return weights;
}

/// Weights of the spline of a degree, 1 to 3, at `cells` from the node 0, folded at walls on the nodes `low` and
/// `high`. The first degree is the hat, which no wall folds.
inline AxisWeights spline_weights(int degree, double cells, double low = -kFarWall, double high = kFarWall) {
  if (degree == 3) return folded_weights<CubicSpline<double>>(cells, low, high);
  if (degree == 2) return folded_weights<QuadraticSpline<double>>(cells, low, high);
  const double below = std::floor(cells);
  return {static_cast<int>(below), 2, {1.0 - (cells - below), cells - below}};
}

}  // namespace mpm
