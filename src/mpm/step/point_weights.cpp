#include "mpm/step/point_weights.hpp"

#include <cmath>

#include "mpm/shape/spline_weights.hpp"

namespace mpm {
namespace {

AxisWeights axis_weights(const Grid& grid, ShapeKind shape, int k, double cells) {
  return spline_weights(traits_of(shape).surface_degree, cells, grid.has_wall[2 * k] ? 0.0 : -kFarWall,
                        grid.has_wall[2 * k + 1] ? grid.layout.last_node(k) : kFarWall);
}

}  // namespace

PointWeights::PointWeights(const MaterialNodes& nodes, ShapeKind shape, const Vec3& at) {
  const Grid& grid = nodes.grid();
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
        const FieldNode found = nodes.find({along[0].first + i, along[1].first + j, along[2].first + l});
        if (found.ref.block < 0) continue;
        node[count] = found;
        weight[count] = value;
        sum += value;
        ++count;
      }
    }
  }
  for (int i = 0; i < count; ++i) weight[i] /= sum;
}

}  // namespace mpm
