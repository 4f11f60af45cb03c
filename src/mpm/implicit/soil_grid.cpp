#include "mpm/implicit/soil_grid.hpp"

#include <algorithm>

namespace mpm {

namespace {

GridLayout widened(const GridLayout& layout) {
  Vec3 cell = Vec3::Ones(), min = Vec3::Zero(), max = Vec3::Zero();
  for (int k = 0; k < layout.dim(); ++k) {
    const int axis = layout.axis(k);
    cell[axis] = layout.cell(k);
    const int beyond = layout.periodic(k) ? 0 : kBlockEdge;
    min[axis] = layout.origin(k) - beyond * layout.cell(k);
    max[axis] = layout.origin(k) + (layout.last_node(k) + beyond) * layout.cell(k);
  }
  GridLayout wider(layout.dim(), cell, min, max);
  for (int k = 0; k < layout.dim(); ++k) {
    if (layout.periodic(k)) wider.make_periodic(k);
  }
  return wider;
}

}  // namespace

SoilGrid::SoilGrid(const Grid& grid, const std::array<WallDefinition, 6>& walls, bool rings, int threads)
    : grid_(grid), walls_(walls), rings_(rings), threads_(threads), wider_(widened(grid.layout)), swept_(wider_) {}

bool SoilGrid::rebuild() {
  if (generation_ == grid_.blocks.generation()) {
    if (prescribed_ != grid_.prescribed) find_held();
    return false;
  }
  generation_ = grid_.blocks.generation();
  const int blocks = grid_.blocks.size();
  keys_.resize(blocks);
  for (int b = 0; b < blocks; ++b) {
    std::array<int, 3> block = grid_.blocks.block(b);
    for (int k = 0; k < grid_.layout.dim(); ++k) block[k] += grid_.layout.periodic(k) ? 0 : 1;
    keys_[b] = wider_.key(block);
  }
  swept_.rebuild(keys_, threads_);
  // Those that hold particles have most of the cells; all have one, since a cell may come to any.
  work_.assign(blocks, 1);
  for (int owner = 0; owner < grid_.blocks.owners(); ++owner) {
    work_[grid_.blocks.owner_block(owner)] = static_cast<std::uint32_t>(grid_.layout.nodes_per_block());
  }
  shares_.rebuild(swept_, work_, threads_);
  find_around();
  find_held();
  return true;
}

void SoilGrid::find_around() {
  const int dim = grid_.layout.dim(), count = neighbours(), blocks = grid_.blocks.size();
  around_.assign(static_cast<std::size_t>(count) * blocks, -1);
  for (int b = 0; b < blocks; ++b) {
    for (int n = 0; n < count; ++n) {
      std::array<int, 3> near = grid_.blocks.block(b);
      bool numbered = true;  // beyond the first and the last block there are no keys, but along a periodic axis
      for (int k = dim - 1, rest = n; k >= 0; --k, rest /= 3) {
        near[k] += rest % 3 - 1;
        const bool inside = near[k] >= -1 && kBlockEdge * near[k] <= grid_.layout.last_node(k) + kBlockEdge;
        numbered = numbered && (inside || grid_.layout.periodic(k));
      }
      if (numbered) around_[static_cast<std::size_t>(count) * b + n] = grid_.blocks.find(grid_.layout.key(near));
    }
  }
}

void SoilGrid::find_held() {
  const GridLayout& layout = grid_.layout;
  const int per_block = layout.nodes_per_block();
  holders_.assign(3 * static_cast<std::size_t>(numbers()), kFree);
  frictional_.clear();
  for (int b = 0; b < grid_.blocks.size(); ++b) {
    for (int face = 0; face < 2 * layout.dim(); ++face) {
      const int k = face / 2, axis = layout.axis(k), wall = 2 * axis + face % 2;
      if (!is_wall(walls_[wall].kind)) continue;
      const int first = kBlockEdge * grid_.blocks.block(b)[k];
      const bool reaches = face % 2 == 1 ? first + kBlockEdge > layout.last_node(k) : first <= 0;
      if (!reaches) continue;
      for (int n = 0; n < per_block; ++n) {
        const int at = layout.node(grid_.blocks.block(b), n)[k];
        const int beyond = face % 2 == 1 ? at - layout.last_node(k) : -at;
        if (beyond < 0 || beyond > grid_.wall_layers) continue;
        const int node = b * per_block + n;
        std::uint8_t* own = &holders_[3 * static_cast<std::size_t>(node)];
        switch (walls_[wall].kind) {
          case WallKind::frictional:
            frictional_.push_back({b, node, wall});
            break;
          case WallKind::fixed:
            for (int a = 0; a < 3; ++a) {
              if (own[a] == kFree) own[a] = static_cast<std::uint8_t>(wall);
            }
            break;
          default:
            own[axis] = static_cast<std::uint8_t>(wall);
        }
      }
    }
  }
  if (axis()) {
    for (int node = 0; node < nodes(); ++node) {
      const int at = layout.node(grid_.blocks.block(node / per_block), node % per_block)[0];
      if (at <= 0) holders_[3 * static_cast<std::size_t>(node)] = kAxis;
    }
  }
  prescribed_ = grid_.prescribed;
  for (const auto& [ref, axis] : prescribed_) {  // they stand above walls
    holders_[3 * static_cast<std::size_t>(ref.block * per_block + ref.node) + axis] = kPrescribed;
  }
  for (const NodeRef& rests : grid_.at_rest) {
    std::uint8_t* own = &holders_[3 * static_cast<std::size_t>(rests.block * per_block + rests.node)];
    for (int a = 0; a < 3; ++a) {
      if (own[a] == kFree) own[a] = kAtRest;
    }
  }
}

int SoilGrid::corner(int block, const std::array<int, 3>& local, int corner) const {
  const int dim = grid_.layout.dim();
  int near = 0, number = 0;
  for (int k = 0; k < dim; ++k) {
    const int at = local[k] + (corner >> k & 1), above = at == kBlockEdge ? 1 : 0;
    near = 3 * near + 1 + above;
    number = kBlockEdge * number + (above != 0 ? 0 : at);
  }
  const int found = around_[static_cast<std::size_t>(neighbours()) * block + near];
  return found < 0 ? no_node(block) : found * grid_.layout.nodes_per_block() + number;
}

bool SoilGrid::find(const std::array<int, 3>& at, int& block, std::array<int, 3>& local) const {
  std::array<int, 3> of{};
  for (int k = 0; k < grid_.layout.dim(); ++k) {
    of[k] = at[k] >> 2;
    local[k] = at[k] - kBlockEdge * of[k];
    if (at[k] < -kBlockEdge || at[k] > grid_.layout.last_node(k) + kBlockEdge) return false;
  }
  static_assert(kBlockEdge == 4);
  block = grid_.blocks.find(grid_.layout.key(of));
  return block >= 0;
}

}  // namespace mpm
