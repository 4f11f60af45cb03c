#include "mpm/step/material_nodes.hpp"

namespace mpm {

bool has_nodes(const GridLayout& layout, int axis, double cells) {
  return cells >= 2 - kBlockEdge && cells <= layout.last_node(axis) + kBlockEdge - 2;
}

FieldNode MaterialNodes::find(const std::array<int, 3>& number) const {
  if (sides_ != nullptr) {
    const FieldNode found = sides_->node_of(set_, from_, number);
    const bool carries = found.ref.block >= 0 && fields_[found.field]->carries(found.ref.block, found.ref.node);
    return carries ? found : FieldNode{};
  }
  const Grid& grid = *fields_[field_];
  std::array<int, 3> block{};
  int local = 0;
  for (int k = 0; k < grid.layout.dim(); ++k) {
    block[k] = (number[k] + kBlockEdge) / kBlockEdge - 1;
    local = local * kBlockEdge + number[k] - block[k] * kBlockEdge;
  }
  const int found = grid.blocks.find(grid.layout.key(block));
  return {field_, {found < 0 || !grid.carries(found, local) ? -1 : found, local}};
}

FieldNode MaterialNodes::nearest(const Vec3& at) const {
  const GridLayout& layout = grid().layout;
  std::array<int, 3> number{};
  for (int k = 0; k < layout.dim(); ++k) {
    const double cells = layout.in_cells(k, at[layout.axis(k)]);
    if (!has_nodes(layout, k, cells)) return {};
    number[k] = GridLayout::nearest(cells);
  }
  return find(number);
}

}  // namespace mpm
