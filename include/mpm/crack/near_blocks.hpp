// Blocks whose particles may have nodes near something: those whose tile (grid/node_choice.hpp) it meets.
#pragma once

#include <algorithm>
#include <cmath>

#include "mpm/grid/node_choice.hpp"

namespace mpm {

/// visit(block) for every block of the domain whose tile meets a box, given by its corners [m], grown by `margin`
/// [cells].
template <class Visit>
void each_block_near(const GridLayout& layout, const Vec2& low, const Vec2& high, double margin, Visit&& visit) {
  constexpr int kAfter = NodeChoice::kEdge - NodeChoice::kMargin - 1;  // last node of a tile, from the block's first
  std::array<int, 2> first{}, last{};
  for (int a = 0; a < 2; ++a) {
    const double from = layout.in_cells(a, low[a]) - margin, to = layout.in_cells(a, high[a]) + margin;
    const double last_block = layout.last_node(a) / static_cast<double>(kBlockEdge);
    first[a] = static_cast<int>(std::clamp(std::ceil((from - kAfter) / kBlockEdge), 0.0, last_block + 1.0));
    last[a] = static_cast<int>(std::clamp(std::floor((to + NodeChoice::kMargin) / kBlockEdge), -1.0, last_block));
  }
  for (int i = first[0]; i <= last[0]; ++i) {
    for (int j = first[1]; j <= last[1]; ++j) visit(std::array<int, 3>{i, j, 0});
  }
}

}  // namespace mpm
