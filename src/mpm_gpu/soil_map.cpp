#include "mpm_gpu/soil_map.hpp"

namespace mpm_gpu {

static_assert(kFreeComponent == mpm::SoilGrid::kFree && kAtRestComponent == mpm::SoilGrid::kAtRest);

template <class T>
void SoilMap<T>::make_room(long nodes) {
  const long blocks = nodes / layout_.nodes_per_block();
  holder_.fit(3 * nodes);
  flag_.fit(blocks);
  nodes_there_.fit(nodes);
  order_.fit(blocks);
}

template <class T>
void SoilMap<T>::take_blocks(Executor& run, const Step<T>& step, const SoilPassTable<T>& passes, mpm::Grid& grid,
                             mpm::HostRest* rest) {
  const long all = step.nodes.blocks;
  const int dim = layout_.dim();
  copies_.download_keys(run, step.nodes, keys_);
  passes.owners(run, step, flag_.data());
  bytes_.resize(static_cast<std::size_t>(all));
  flag_.download(bytes_.data(), all);
  owners_.clear();
  for (std::size_t b = 0; b < keys_.size(); ++b) {
    if (bytes_[b] != 0) owners_.push_back(layout_.key(host_block(step.grid, dim, keys_[b])));
  }
  grid.rebuild(owners_);
  grid.first_owner = 0;
  blocks_.clear();
  nodes_.clear();
  const std::int32_t per_block = layout_.nodes_per_block();
  for (int b = 0; b < grid.blocks.size(); ++b) {
    const std::uint64_t key = key_of_host_block(step.grid, dim, grid.blocks.block(b));
    blocks_.push_back(place_of(keys_.data(), all, key));
    for (std::int32_t n = 0; n < per_block; ++n) nodes_.push_back(blocks_.back() * per_block + n);
  }
  nodes_there_.upload(nodes_);
  table_ = step.nodes.nodes;
  none_ = static_cast<std::int32_t>(table_);
  take_rest(grid, rest);
}

// Sleep has a grid of its own, of the blocks that the host has sorted particles into.
template <class T>
void SoilMap<T>::take_rest(mpm::Grid& grid, mpm::HostRest* rest) {
  grid.at_rest.clear();
  at_rest_.clear();
  if (rest == nullptr) return;
  const mpm::Grid& of = *rest->fields().front();
  for (const mpm::NodeRef& node : of.at_rest) {
    const int block = grid.blocks.find(of.blocks.key(node.block));
    if (block < 0) continue;
    grid.at_rest.push_back({block, node.node});
    at_rest_.push_back(this->node(block * layout_.nodes_per_block() + node.node));
  }
  at_rest_there_.grow(at_rest());
  at_rest_there_.upload(at_rest_);
}

template <class T>
void SoilMap<T>::take_grid(const mpm::SoilGrid& grid) {
  bytes_.assign(static_cast<std::size_t>(3 * table_), kFreeComponent);
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    std::uint8_t* of_node = &bytes_[3 * static_cast<std::size_t>(nodes_[n])];
    for (int a = 0; a < 3; ++a) of_node[a] = grid.holder(static_cast<int>(n), a);
  }
  holder_.upload(bytes_);
  list_.clear();
  const int colours = 1 << layout_.dim();
  for (int c = 0; c < colours; ++c) {
    begin_[static_cast<std::size_t>(c)] = static_cast<long>(list_.size());
    for (const int block : grid.blocks_of_colour(c)) list_.push_back(blocks_[static_cast<std::size_t>(block)]);
  }
  begin_[static_cast<std::size_t>(colours)] = static_cast<long>(list_.size());
  order_.upload(list_);
}

template <class T>
std::size_t SoilMap<T>::bytes() const {
  return holder_.bytes() + flag_.bytes() + nodes_there_.bytes() + order_.bytes() + at_rest_there_.bytes();
}

template class SoilMap<double>;
template class SoilMap<float>;

}  // namespace mpm_gpu
