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

/// True if a place may be looked up along an axis: nodes may be as far as a block beyond the domain.
bool has_nodes(const GridLayout& layout, int k, double cells) {
  return cells >= 2 - kBlockEdge && cells <= layout.last_node(k) + kBlockEdge - 2;
}

/// A node by its number along each axis; its block is -1 if it carries no mass.
NodeRef node_that_carries(const Grid& grid, const std::array<int, 3>& number) {
  std::array<int, 3> block{};
  int local = 0;
  for (int k = 0; k < grid.layout.dim(); ++k) {
    block[k] = (number[k] + kBlockEdge) / kBlockEdge - 1;
    local = local * kBlockEdge + number[k] - block[k] * kBlockEdge;
  }
  const int found = grid.blocks.find(grid.layout.key(block));
  return {found < 0 || !grid.carries(found, local) ? -1 : found, local};
}

}  // namespace

PointWeights::PointWeights(const Grid& grid, ShapeKind shape, const Vec3& at) {
  const GridLayout& layout = grid.layout;
  const int dim = layout.dim();
  std::array<AxisWeights, 3> along;
  for (AxisWeights& one : along) one = {0, 1, {1.0}};
  for (int k = 0; k < dim; ++k) {
    const double cells = layout.in_cells(k, at[layout.axis(k)]);
    if (!has_nodes(layout, k, cells)) return;
    along[k] = axis_weights(grid, shape, k, cells);
  }
  double sum = 0.0;
  for (int i = 0; i < along[0].count; ++i) {
    for (int j = 0; j < along[1].count; ++j) {
      for (int l = 0; l < along[2].count; ++l) {
        const double value = along[0].weight[i] * along[1].weight[j] * along[2].weight[l];
        if (value == 0.0) continue;
        const NodeRef found = node_that_carries(grid, {along[0].first + i, along[1].first + j, along[2].first + l});
        if (found.block < 0) continue;
        node[count] = found;
        weight[count] = value;
        sum += value;
        ++count;
      }
    }
  }
  for (int i = 0; i < count; ++i) weight[i] /= sum;
}

NodeRef nearest_node(const Grid& grid, const Vec3& at) {
  std::array<int, 3> number{};
  for (int k = 0; k < grid.layout.dim(); ++k) {
    const double cells = grid.layout.in_cells(k, at[grid.layout.axis(k)]);
    if (!has_nodes(grid.layout, k, cells)) return {-1, 0};
    number[k] = GridLayout::nearest(cells);
  }
  return node_that_carries(grid, number);
}

}  // namespace mpm
