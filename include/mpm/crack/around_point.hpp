// The nodes around a place in the plane and their hat functions, for points that have no domain.
#pragma once

#include <array>
#include <cmath>

#include "mpm/grid/grid_layout.hpp"
#include "mpm/math/geometry.hpp"

namespace mpm {

/// visit(numbers of a node, its hat function) for the four nodes around a place; for none far out of the domain.
template <class Visit>
void each_hat(const GridLayout& layout, const Vec2& place, Visit&& visit) {
  std::array<int, 2> low{};
  std::array<double, 2> beyond{};
  for (int k = 0; k < 2; ++k) {
    const double cells = layout.in_cells(k, place[k]);
    if (!(cells >= -kBlockEdge && cells < layout.last_node(k) + kBlockEdge - 1)) return;
    low[k] = static_cast<int>(std::floor(cells));
    beyond[k] = cells - low[k];
  }
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const double hat = (i == 1 ? beyond[0] : 1.0 - beyond[0]) * (j == 1 ? beyond[1] : 1.0 - beyond[1]);
      if (hat > 0.0) visit(std::array<int, 2>{low[0] + i, low[1] + j}, hat);
    }
  }
}

}  // namespace mpm
