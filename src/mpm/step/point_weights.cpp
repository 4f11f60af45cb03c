#include "mpm/step/point_weights.hpp"

#include <cmath>

#include "mpm/shape/bspline.hpp"

namespace mpm {
namespace {

/// Along one axis: nodes first, first + 1, …
struct AxisWeights {
  int first = 0, count = 0;
  std::array<double, 5> weight{};
};

template <class Spline>
AxisWeights spline_weights(const Grid& grid, int k, double cells) {
  const int nearest = GridLayout::nearest(cells);
  Spline spline(cells - nearest, typename Spline::Axis(0.0, grid.layout.inverse_cell(k)));
  constexpr double kFar = 1e9;
  spline.fold(grid.has_wall[2 * k] ? nearest : kFar,
              grid.has_wall[2 * k + 1] ? grid.layout.last_node(k) - nearest : kFar);
  AxisWeights weights{nearest - Spline::kNodes / 2, Spline::kNodes, {}};
  for (int n = 0; n < Spline::kNodes; ++n) weights.weight[n] = spline.s[n];
  return weights;
}

AxisWeights axis_weights(const Grid& grid, ShapeKind shape, int k, double cells) {
  if (shape == ShapeKind::bspline3) return spline_weights<CubicSpline<double>>(grid, k, cells);
  const double below = std::floor(cells);
  return {static_cast<int>(below), 2, {1.0 - (cells - below), cells - below}};
}

}  // namespace

PointWeights::PointWeights(const Grid& grid, ShapeKind shape, const Vec3& at) {
  const GridLayout& layout = grid.layout;
  const int dim = layout.dim();
  std::array<AxisWeights, 3> along;
  for (AxisWeights& one : along) one = {0, 1, {1.0}};
  for (int k = 0; k < dim; ++k) {
    const double cells = layout.in_cells(k, at[layout.axis(k)]);
    // Nodes may be as far as a block beyond the domain.
    if (!(cells >= 2 - kBlockEdge && cells <= layout.last_node(k) + kBlockEdge - 2)) return;
    along[k] = axis_weights(grid, shape, k, cells);
  }
  double sum = 0.0;
  for (int i = 0; i < along[0].count; ++i) {
    for (int j = 0; j < along[1].count; ++j) {
      for (int l = 0; l < along[2].count; ++l) {
        const double value = along[0].weight[i] * along[1].weight[j] * along[2].weight[l];
        if (value == 0.0) continue;
        const int number[3] = {along[0].first + i, along[1].first + j, along[2].first + l};
        std::array<int, 3> block{};
        int local = 0;
        for (int k = 0; k < dim; ++k) {
          block[k] = (number[k] + kBlockEdge) / kBlockEdge - 1;
          local = local * kBlockEdge + number[k] - block[k] * kBlockEdge;
        }
        const int found = grid.blocks.find(layout.key(block));
        if (found < 0 || !grid.carries(found, local)) continue;
        node[count] = {found, local};
        weight[count] = value;
        sum += value;
        ++count;
      }
    }
  }
  for (int i = 0; i < count; ++i) weight[i] /= sum;
}

}  // namespace mpm
