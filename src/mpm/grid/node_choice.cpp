#include "mpm/grid/node_choice.hpp"

#include <algorithm>

namespace mpm {

namespace {

/// Neighbour that a tile's node lies in, and its place there.
NodeChoice::Node place_in_tile(int dim, int tile_node) {
  int neighbour = 0, local = 0, neighbour_stride = 1, local_stride = 1;
  for (int k = dim - 1; k >= 0; --k, tile_node /= NodeChoice::kEdge) {
    const int at = tile_node % NodeChoice::kEdge - NodeChoice::kMargin + kBlockEdge;
    neighbour += at / kBlockEdge * neighbour_stride;
    local += at % kBlockEdge * local_stride;
    neighbour_stride *= 3;
    local_stride *= kBlockEdge;
  }
  return {neighbour, local};
}

}  // namespace

NodeChoice::NodeChoice(Fields& fields, std::vector<int> chosen)
    : fields_(fields), chosen_(std::move(chosen)), grid_(fields.front()->layout) {
  for (int node = 0; node < kTileNodes; ++node) in_tile_[node] = place_in_tile(grid_.layout.dim(), node);
}

void NodeChoice::set_blocks(std::vector<std::uint64_t> keys, int first_owner) {
  block_keys_.swap(keys);
  grid_.first_owner = first_owner;
  find_places();
  clear_patches();
  ++sorted_;
}

void NodeChoice::find_places() {
  const GridLayout& layout = grid_.layout;
  const int span = neighbours_of(layout.dim());
  places_.assign(block_keys_.size() * fields_.size() * span, -1);
  for (std::size_t b = 0; b < block_keys_.size(); ++b) {
    const std::array<int, 3> owner = layout.block(block_keys_[b]);
    for (int s = 0; s < span; ++s) {
      const std::uint64_t key = layout.key(neighbour_of(owner, s, layout.dim()));
      for (const int f : chosen_) places_[(b * fields_.size() + f) * span + s] = fields_[f]->blocks.find(key);
    }
  }
}

void NodeChoice::clear_patches() {
  patch_blocks_.clear();
  patch_keys_.clear();
  entries_.clear();
  jumps_.clear();
  chosen_at_.clear();
}

int NodeChoice::add_patch(int block) {
  patch_blocks_.push_back(block);
  patch_keys_.push_back(block_keys_[block]);
  chosen_at_.insert(chosen_at_.end(), kTileNodes, -1);
  return patches() - 1;
}

NodeChoice::Node NodeChoice::node_of(int block, int tile_node, int field) const {
  const Node& at = in_tile_[tile_node];
  return {places_[(block * fields_.size() + field) * neighbours_of(grid_.layout.dim()) + at.block], at.node};
}

void NodeChoice::choose(int patch, int tile_node, int field) {
  const Node own = in_tile_[tile_node], of = node_of(patch_blocks_[patch], tile_node, field);
  entries_.push_back({patch * neighbours_of(grid_.layout.dim()) + own.block, of.block,
                      static_cast<std::uint8_t>(own.node), static_cast<std::uint8_t>(of.node),
                      static_cast<std::uint16_t>(field)});
  chosen_at_[static_cast<std::size_t>(patch) * kTileNodes + tile_node] = static_cast<std::int16_t>(field);
}

void NodeChoice::jump(int patch, int tile_node, const Vec2& by) {
  const Node& own = in_tile_[tile_node];
  jumps_.push_back({patch * neighbours_of(grid_.layout.dim()) + own.block, static_cast<std::uint8_t>(own.node), by});
}

void NodeChoice::find_givers(int field, const std::vector<std::uint8_t>& marked,
                             std::vector<std::uint8_t>& patches) const {
  patches.assign(patch_blocks_.size(), 0);
  const int span = neighbours_of(grid_.layout.dim());
  for (const Entry& entry : entries_) {
    if (entry.field == field && marked[entry.block] != 0) patches[entry.own_block / span] = 1;
  }
}

int NodeChoice::chosen_at(int patch, const std::array<int, 3>& node) const {
  const std::array<int, 3>& block = grid_.blocks.block(grid_.blocks.owner_block(patch));
  int tile_node = 0;
  for (int k = 0; k < grid_.layout.dim(); ++k) {
    const int at = node[k] - block[k] * kBlockEdge + kMargin;
    if (at < 0 || at >= kEdge) return -1;
    tile_node = tile_node * kEdge + at;
  }
  return chosen_at_[static_cast<std::size_t>(patch) * kTileNodes + tile_node];
}

void NodeChoice::finish(int threads) {
  grid_.blocks.rebuild_apart(patch_keys_);
  grid_.shares.rebuild(grid_.blocks, {}, threads);
  for (NodalField* field : {&grid_.mass, &grid_.momentum, &grid_.velocity, &grid_.force}) {
    field->resize(grid_.blocks.size());
  }
  // The others are zeroed before they are spread to; of this one, nodes that stand for none are read with no weight.
  NodalField& velocity = grid_.velocity;
  std::fill_n(velocity.data(), grid_.blocks.size() * velocity.components() * grid_.layout.nodes_per_block(), 0.0);
  grid_.loose.assign(grid_.blocks.owners(), 1);  // particles are taken as far from their block as a tile reaches
  const Grid& like = *fields_[chosen_.front()];
  grid_.least_mass = like.least_mass;
  grid_.wall_layers = like.wall_layers;
  grid_.has_wall = like.has_wall;
  grid_.mirrors = like.mirrors;
}

void NodeChoice::clear(NodalField& own) const {
  for (const Entry& entry : entries_) {
    for (int c = 0; c < own.components(); ++c) own.at(entry.own_block, c, entry.own_node) = 0.0;
  }
}

void NodeChoice::give(NodalField Grid::*what) {
  const NodalField& own = grid_.*what;
  const int components = own.components(), nodes = grid_.layout.nodes_per_block();
  for (const Entry& entry : entries_) {
    double* to = ((*fields_[entry.field]).*what).block(entry.block) + entry.node;
    const double* from = own.block(entry.own_block) + entry.own_node;
    for (int c = 0; c < components; ++c) to[c * nodes] += from[c * nodes];
  }
}

void NodeChoice::take(NodalField Grid::*what) {
  NodalField& own = grid_.*what;
  const int components = own.components(), nodes = grid_.layout.nodes_per_block();
  for (const Entry& entry : entries_) {
    double* to = own.block(entry.own_block) + entry.own_node;
    const double* from = ((*fields_[entry.field]).*what).block(entry.block) + entry.node;
    for (int c = 0; c < components; ++c) to[c * nodes] = from[c * nodes];
  }
}

void NodeChoice::take_for_strain(double step) {
  take(&Grid::velocity);
  for (const Jump& jump : jumps_) {
    for (int c = 0; c < 2; ++c) grid_.velocity.at(jump.own_block, c, jump.own_node) += jump.by[c] / step;
  }
}

void NodeChoice::give(const NodalField& own, int field, NodalField& to) const {
  for (const Entry& entry : entries_) {
    if (entry.field != field) continue;
    for (int c = 0; c < own.components(); ++c) {
      to.at(entry.block, c, entry.node) += own.at(entry.own_block, c, entry.own_node);
    }
  }
}

void NodeChoice::take(const NodalField& from, int field, NodalField& own) const {
  for (const Entry& entry : entries_) {
    if (entry.field != field) continue;
    for (int c = 0; c < own.components(); ++c) {
      own.at(entry.own_block, c, entry.own_node) = from.at(entry.block, c, entry.node);
    }
  }
}

}  // namespace mpm
