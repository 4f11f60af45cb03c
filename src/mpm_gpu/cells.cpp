#include "mpm_gpu/cells.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace mpm_gpu {

CellTable::CellTable(const GridView& grid, int dim)
    : grid_(grid),
      dim_(dim),
      around_(neighbours_of(dim)),
      per_block_(static_cast<std::uint64_t>(nodes_of_block(dim))),
      block_keys_(1) {
  for (int k = 0; k < dim; ++k) block_keys_ *= static_cast<std::uint64_t>(grid.blocks_along[k]);
}

void CellTable::make_room(Executor& run, const Places& places, const std::vector<SetView>& sets) {
  particles_ = 0;
  for (const SetView& set : sets) particles_ += set.count;
  sets_ = static_cast<int>(sets.size());
  for (auto* buffer : {&key_, &other_key_, &cell_key_}) buffer->fit(particles_);
  for (auto* buffer : {&order_, &other_order_, &flag_, &node_}) buffer->fit(particles_);
  run.reserve(key_.size());
  find_keys(run, places, sets);
  const long owners = find_owners(run);
  if (owners_room_ >= owners + owners / 2) return;
  owners_room_ = 2 * owners + 64;
  const long candidates = owners_room_ * around_;
  // Blocks around others are shared: of the owners in a compact body fewer than twice as many blocks are in use.
  room_ = std::min(candidates, 4 * owners_room_ + 512);
  for (auto* buffer : {&key_, &other_key_}) buffer->fit(std::max(candidates, particles_));
  for (auto* buffer : {&order_, &other_order_, &flag_}) buffer->fit(std::max(candidates, particles_));
  run.reserve(key_.size());
  owner_.fit(owners_room_);
  block_.fit(room_);
  neighbours_.fit(room_ * around_);
  for (auto* buffer : {&begin_, &end_}) buffer->fit(room() * sets_);
}

void CellTable::sort(Executor& run, const Places& places, const std::vector<SetView>& sets) {
  find_keys(run, places, sets);
  const long owners = find_owners(run);
  if (owners > owners_room_) {
    throw GpuError(
        fmt::format("gpu: particles have spread to {} blocks of the grid in a sync period, and there is room "
                    "for {}: shorten time.sync",
                    owners, owners_room_));
  }
  // The arrays of keys and of the order have another use below: what the caller needs of them is kept.
  const std::uint64_t *key = key_.data(), nodes = per_block_;
  std::uint64_t* kept = cell_key_.data();
  std::uint32_t *order = order_.data(), *kept_order = node_.data();
  run.for_each("gpu: sort", particles_, [=](long i) {
    kept[i] = key[i];
    kept_order[i] = order[i];
  });
  const std::uint32_t* flag = flag_.data();
  std::uint64_t* owner = owner_.data();
  const std::uint64_t block_keys = block_keys_;
  run.for_each("gpu: blocks", particles_, [=](long i) {
    if (i == 0 || key[i] / nodes != key[i - 1] / nodes) owner[flag[i]] = key[i] / nodes % block_keys;
  });
  find_blocks(run, owners);
  run.for_each("gpu: sort", particles_, [=](long i) { order[i] = kept_order[i]; });
  find_ranges(run, static_cast<int>(sets.size()));
}

void CellTable::find_keys(Executor& run, const Places& places, const std::vector<SetView>& sets) {
  struct Kernel {
    GridView grid;
    Places places;
    std::uint64_t before, nodes;
    std::uint64_t* key;
    std::uint32_t* order;
    std::uint32_t first, first_id;
    int dim;
    constexpr void operator()(long i) const {
      const long p = first + i;
      std::uint64_t block = 0, local = 0;
      for (int k = 0; k < dim; ++k) {
        const auto node =
            static_cast<std::uint64_t>(around(grid, k, nearest_node(in_cells(grid, k, places.x[k][p]))) + kBeside);
        block = block * static_cast<std::uint64_t>(grid.blocks_along[k]) + node / kEdge;
        local = local * kEdge + node % kEdge;
      }
      const std::uint32_t id = places.id[p],
                          by_id = places.number != nullptr ? places.number[id] : first + (id - first_id);
      key[by_id] = (before + block) * nodes + local;
      order[by_id] = static_cast<std::uint32_t>(p);
    }
  };
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const Kernel kernel{grid_,         places,        s * block_keys_,  per_block_, key_.data(),
                        order_.data(), sets[s].first, sets[s].first_id, dim_};
    run.for_each("gpu: keys of cells", sets[s].count, kernel);
  }
}

long CellTable::find_owners(Executor& run) {
  run.stable_sort(key_.data(), order_.data(), other_key_.data(), other_order_.data(), particles_,
                  static_cast<std::uint64_t>(sets_) * block_keys_ * per_block_);
  const std::uint64_t *key = key_.data(), nodes = per_block_;
  std::uint32_t* flag = flag_.data();
  run.for_each("gpu: blocks", particles_,
               [=](long i) { flag[i] = i == 0 || key[i] / nodes != key[i - 1] / nodes ? 1U : 0U; });
  return run.exclusive_scan(flag, flag, particles_);
}

void CellTable::find_blocks(Executor& run, long owners) {
  const GridView grid = grid_;
  const int dim = dim_;
  std::uint64_t *key = key_.data(), *block = block_.data();
  const std::uint64_t* owner = owner_.data();
  std::uint32_t* flag = flag_.data();
  const int around = around_;
  const long candidates = owners * around;
  run.for_each("gpu: blocks", candidates,
               [=](long i) { key[i] = neighbour_key(grid, dim, owner[i / around], static_cast<int>(i % around)); });
  run.stable_sort(key, order_.data(), other_key_.data(), other_order_.data(), candidates, block_keys_);
  run.for_each("gpu: blocks", candidates, [=](long i) { flag[i] = i == 0 || key[i] != key[i - 1] ? 1U : 0U; });
  blocks_ = run.exclusive_scan(flag, flag, candidates);
  if (blocks_ > room_) {
    throw GpuError(
        fmt::format("gpu: particles have spread over {} blocks of the grid in a sync period, and there is "
                    "room for {}: shorten time.sync",
                    blocks_, room_));
  }
  run.for_each("gpu: blocks", candidates, [=](long i) {
    if (i == 0 || key[i] != key[i - 1]) block[flag[i]] = key[i];
  });
  std::int32_t* neighbours = neighbours_.data();
  const long blocks = blocks_;
  run.for_each("gpu: blocks", blocks * around, [=](long i) {
    neighbours[i] = place_of(block, blocks, neighbour_key(grid, dim, block[i / around], static_cast<int>(i % around)));
  });
}

void CellTable::find_ranges(Executor& run, int sets) {
  const long nodes = blocks_ * static_cast<long>(per_block_), blocks = blocks_, particles = particles_;
  std::uint32_t *begin = begin_.data(), *end = end_.data(), *node = node_.data();
  run.for_each("gpu: ranges of cells", nodes * sets, [=](long i) { begin[i] = end[i] = 0; });
  const std::uint64_t *key = cell_key_.data(), *block = block_.data(), of_set = block_keys_ * per_block_,
                      per_block = per_block_;
  run.for_each("gpu: ranges of cells", particles, [=](long i) {
    const std::uint64_t cell = key[i] % of_set;
    const long at =
        place_of(block, blocks, cell / per_block) * static_cast<long>(per_block) + static_cast<long>(cell % per_block);
    const long row = static_cast<long>(key[i] / of_set) * nodes + at;
    node[i] = static_cast<std::uint32_t>(at);
    if (i == 0 || key[i] != key[i - 1]) begin[row] = static_cast<std::uint32_t>(i);
    if (i == particles - 1 || key[i] != key[i + 1]) end[row] = static_cast<std::uint32_t>(i + 1);
  });
}

NodeView CellTable::view() const {
  NodeView view{};
  view.blocks = blocks_;
  view.nodes = blocks_ * static_cast<long>(per_block_);
  view.key = block_.data();
  view.neighbours = neighbours_.data();
  view.begin = begin_.data();
  view.end = end_.data();
  return view;
}

std::size_t CellTable::bytes() const {
  std::size_t sum = neighbours_.bytes() + begin_.bytes() + end_.bytes();
  for (const auto* buffer : {&key_, &other_key_, &cell_key_, &owner_, &block_}) sum += buffer->bytes();
  for (const auto* buffer : {&order_, &other_order_, &flag_, &node_}) sum += buffer->bytes();
  return sum;
}

}  // namespace mpm_gpu
