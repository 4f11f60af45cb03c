#include "mpm/sleep/sleep_border.hpp"

#include <algorithm>

namespace mpm {
namespace {

/// Of a node of one block in the tile of another; -1 when it is outside. `apart`: blocks from the other to the first.
int in_tile(const GridLayout& layout, const std::array<int, 3>& apart, int node) {
  std::array<int, 3> local{};
  for (int k = layout.dim() - 1; k >= 0; --k, node /= kBlockEdge) local[k] = node % kBlockEdge;
  int place = 0;
  for (int k = 0; k < layout.dim(); ++k) {
    const int at = local[k] + apart[k] * kBlockEdge + BlockForces::kMargin;
    if (at < 0 || at >= BlockForces::kEdge) return -1;
    place = place * BlockForces::kEdge + at;
  }
  return place;
}

bool wall_holds(const Grid& grid, const std::array<int, 3>& node) {
  for (int k = 0; k < grid.layout.dim(); ++k) {
    if (grid.has_wall[2 * k] && node[k] <= 0) return true;
    if (grid.has_wall[2 * k + 1] && node[k] >= grid.layout.last_node(k)) return true;
  }
  return false;
}

}  // namespace

void SleepBorder::find(int field, const Grid& grid, const SleepingBlocks& asleep) {
  nodes_.clear();
  sleepers_.clear();
  if (asleep.all().empty()) return;
  const GridLayout& layout = grid.layout;
  int span = 1;
  for (int k = 0; k < layout.dim(); ++k) span *= 3;
  for (int b = 0; b < grid.blocks.size(); ++b) {
    around_.assign(span, nullptr);
    bool any = false;
    for (int s = 0; s < span; ++s) {
      std::array<int, 3> block = grid.blocks.block(b);
      int rest = s;
      for (int k = layout.dim() - 1; k >= 0; --k, rest /= 3) block[k] += rest % 3 - 1;
      around_[s] = asleep.find({field, layout.key(block)});
      any = any || around_[s] != nullptr;
    }
    if (any) add_block(b, grid, around_);
  }
}

void SleepBorder::add_block(int block, const Grid& grid, const std::vector<const SleepingBlock*>& around) {
  const GridLayout& layout = grid.layout;
  for (int n = 0; n < layout.nodes_per_block(); ++n) {
    Node node;
    node.ref = {block, n};
    node.first = static_cast<int>(sleepers_.size());
    for (std::size_t s = 0; s < around.size(); ++s) {
      if (around[s] == nullptr) continue;
      std::array<int, 3> apart{};
      int rest = static_cast<int>(s);
      for (int k = layout.dim() - 1; k >= 0; --k, rest /= 3) apart[k] = 1 - rest % 3;
      const int t = in_tile(layout, apart, n);
      if (t < 0 || !(around[s]->forces.mass[t] > grid.least_mass)) continue;
      node.mass += around[s]->forces.mass[t];
      for (int k = 0; k < layout.dim(); ++k) node.force[layout.axis(k)] += around[s]->forces.force[k][t];
      node.rate = std::max(node.rate, around[s]->rate);
      sleepers_.push_back(around[s]);
    }
    node.count = static_cast<int>(sleepers_.size()) - node.first;
    if (node.count == 0) continue;
    node.at_wall = wall_holds(grid, layout.node(grid.blocks.block(block), n));
    nodes_.push_back(node);
  }
}

double SleepBorder::unrest(const Node& node, const Grid& grid, const Vec3& gravity) {
  const double awake = grid.mass.at(node.ref.block, 0, node.ref.node), mass = awake + node.mass;
  const double coming = nodal_vector(grid.momentum, grid.layout, node.ref).norm() / mass;
  if (node.at_wall) return coming;
  const Vec3 force = nodal_vector(grid.force, grid.layout, node.ref) + node.force + mass * gravity;
  return std::max(coming, force.norm() / (mass * node.rate));
}

}  // namespace mpm
