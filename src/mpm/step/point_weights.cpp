#include "mpm/step/point_weights.hpp"

#include <cmath>

#include "mpm/shape/spline_weights.hpp"

namespace mpm {
namespace {

AxisWeights axis_weights(const Grid& grid, ShapeKind shape, int k, double cells) {
  return spline_weights(traits_of(shape).surface_degree, cells, grid.has_wall[2 * k] ? 0.0 : -kFarWall,
                        grid.has_wall[2 * k + 1] ? grid.layout.last_node(k) : kFarWall);
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
