#include "mpm/sleep/sleep_border.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace mpm {
SleepBorder::SleepBorder(const GridLayout& layout) : layout_(&layout), sides_(neighbours_of(layout.dim())) {
  const int dim = layout.dim();
  for (int side = 0; side < sides_; ++side) {
    const std::array<int, 3> step = neighbour_of({}, side, dim);
    for (int n = 0; n < layout.nodes_per_block(); ++n) {
      int rest = n, of_tile = 0, stride = 1;
      bool inside = true;
      for (int k = dim - 1; k >= 0; --k, rest /= kBlockEdge, stride *= BlockForces::kEdge) {
        const int at = rest % kBlockEdge - step[k] * kBlockEdge + BlockForces::kMargin;
        inside = inside && at >= 0 && at < BlockForces::kEdge;
        of_tile += at * stride;
      }
      if (inside) shared_[side].push_back({n, of_tile});
    }
  }
}

std::uint64_t SleepBorder::key_beside(const std::array<int, 3>& block, int side) const {
  return layout_->key(neighbour_of(block, side, layout_->dim()));
}

void SleepBorder::find(int field, const Grid& grid, const SleepingBlocks& asleep, const Halo* halo) {
  field_ = field;
  before_.swap(nodes_);
  keys_before_.swap(keys_);
  nodes_.clear();
  keys_.clear();
  if (asleep.finds_none()) return;
  around_.resize(sides_);
  is_awake_.assign(grid.blocks.size(), 0);
  for (int owner = 0; owner < grid.blocks.owners(); ++owner) is_awake_[grid.blocks.owner_block(owner)] = 1;
  reached_by_others_.assign(halo == nullptr ? 0 : grid.blocks.size(), 0);
  if (halo != nullptr) halo->add_reached(field, reached_by_others_);
  for (int b = 0; b < grid.blocks.size(); ++b) {
    bool any = false;
    for (int side = 0; side < sides_; ++side) {
      around_[side] = asleep.find({field, key_beside(grid.blocks.block(b), side)});
      any = any || around_[side] != nullptr;
    }
    if (any) add_block(b, grid);
  }
  keep_means();
}

// Both lists are in ascending order of blocks and nodes.
void SleepBorder::keep_means() {
  std::size_t old = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto is_before = [&](std::size_t o) {
      return keys_before_[o] != keys_[i] ? keys_before_[o] < keys_[i] : before_[o].ref.node < nodes_[i].ref.node;
    };
    while (old < before_.size() && is_before(old)) ++old;
    if (old == before_.size()) return;
    if (keys_before_[old] == keys_[i] && before_[old].ref.node == nodes_[i].ref.node)
      nodes_[i].mean = before_[old].mean;
  }
}

void SleepBorder::find_reached(int block, const Grid& grid) {
  reached_.assign(layout_->nodes_per_block(), 0);
  for (int side = 0; side < sides_; ++side) {
    const int beside = grid.blocks.find(key_beside(grid.blocks.block(block), side));
    if (beside < 0 || is_awake_[beside] == 0) continue;
    for (const Shared& shared : shared_[side]) reached_[shared.node] = 1;
  }
  for (std::size_t n = 0; n < reached_.size() && !reached_by_others_.empty(); ++n) {
    if ((reached_by_others_[block] >> n & 1U) != 0) reached_[n] = 1;
  }
}

void SleepBorder::add_block(int block, const Grid& grid) {
  find_reached(block, grid);
  of_block_.assign(layout_->nodes_per_block(), {});
  for (int side = 0; side < sides_; ++side) {
    if (around_[side] == nullptr) continue;
    const BlockForces& forces = around_[side]->forces;
    for (const Shared& shared : shared_[side]) {
      if (!(forces.mass[shared.of_tile] > grid.least_mass)) continue;
      Node& node = of_block_[shared.node];
      node.mass += forces.mass[shared.of_tile];
      node.stress += forces.stress[shared.of_tile];
      for (int k = 0; k < layout_->dim(); ++k) node.force[layout_->axis(k)] += forces.force[k][shared.of_tile];
      node.rate = std::max(node.rate, around_[side]->rate);
      node.from |= 1U << side;
    }
  }
  for (int n = 0; n < layout_->nodes_per_block(); ++n) {
    Node& node = of_block_[n];
    if (node.from == 0 || reached_[n] == 0) continue;
    node.ref = {block, n};
    const std::array<bool, 3> across = grid.mirrored(layout_->node(grid.blocks.block(block), n));
    node.at_wall = across[0] || across[1] || across[2];
    nodes_.push_back(node);
    keys_.push_back(grid.blocks.key(block));
  }
}

void SleepBorder::add_names(const Node& node, const Grid& grid, std::vector<BlockName>& names) const {
  for (int side = 0; side < sides_; ++side) {
    if ((node.from >> side & 1U) != 0) names.push_back({field_, key_beside(grid.blocks.block(node.ref.block), side)});
  }
}

SleepBorder::Unrest SleepBorder::find_unrest(Node& node, const Grid& grid, const Vec3& of_awake, const Vec3& gravity,
                                             double part) {
  const double awake = grid.mass.at(node.ref.block, 0, node.ref.node), mass = awake + node.mass;
  Unrest unrest{nodal_vector(grid.momentum, grid.layout, node.ref).norm() / mass, 0.0};
  if (node.at_wall) return unrest;
  const Vec3 force = of_awake + node.force + mass * gravity;
  unrest.speed = std::max(unrest.speed, force.norm() / (mass * node.rate));
  node.mean += part * (force - node.mean);
  const double scale = node.force.norm() + mass * gravity.norm();
  if (scale > 0.0) unrest.lost = node.mean.norm() / scale;
  return unrest;
}

void SleepBorder::add_means(std::uint64_t key, std::vector<Mean>& list) const {
  auto i = std::lower_bound(keys_.begin(), keys_.end(), key) - keys_.begin();
  for (; i < static_cast<std::ptrdiff_t>(keys_.size()) && keys_[i] == key; ++i) {
    const Vec3& mean = nodes_[i].mean;
    list.push_back({key, field_, nodes_[i].ref.node, {mean[0], mean[1], mean[2]}});
  }
}

void SleepBorder::take_means(const std::vector<Mean>& list) {
  for (const Mean& one : list) {
    Node node;
    node.ref = {-1, one.node};
    node.mean = Vec3(one.force[0], one.force[1], one.force[2]);
    nodes_.push_back(node);
    keys_.push_back(one.key);
  }
  if (!list.empty()) put_in_order();
}

void SleepBorder::put_in_order() {
  std::vector<std::size_t> order(nodes_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place = [&](std::size_t i) { return std::pair{keys_[i], nodes_[i].ref.node}; };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return place(a) < place(b); });
  order.erase(std::unique(order.begin(), order.end(), [&](auto a, auto b) { return place(a) == place(b); }),
              order.end());
  std::vector<Node> nodes;
  std::vector<std::uint64_t> keys;
  for (const std::size_t i : order) {
    nodes.push_back(nodes_[i]);
    keys.push_back(keys_[i]);
  }
  nodes_.swap(nodes);
  keys_.swap(keys);
}

void SleepBorder::serialise(StateArchive& archive) {
  archive.list("keys", keys_);
  archive.rows("nodes", nodes_);
  archive.column("node", nodes_, [](Node& node) -> int& { return node.ref.node; });
  archive.column("mean", nodes_, &Node::mean);
  if (archive.merging()) put_in_order();
}

}  // namespace mpm
