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
  for (auto* buffer : {&order_, &other_order_, &flag_, &node_}) buffer->fit(particles_ + 1);
  counts_.fit(2);
  run.reserve(flag_.size());
  find_keys(run, places, sets);
  find_owners(run);
  const long owners = flag_.get(particles_);
  if (owners_room_ >= owners + owners / 2) return;
  ++generation_;
  owners_room_ = 2 * owners + 64;
  const long candidates = owners_room_ * around_;
  // Blocks around others are shared: of the owners in a compact body fewer than twice as many blocks are in use.
  room_ = std::min(candidates, 4 * owners_room_ + 512);
  for (auto* buffer : {&key_, &other_key_}) buffer->fit(std::max(candidates, particles_));
  for (auto* buffer : {&order_, &other_order_, &flag_}) buffer->fit(std::max(candidates, particles_) + 1);
  run.reserve(flag_.size());
  owner_.fit(owners_room_);
  block_.fit(room_);
  neighbours_.fit(room_ * around_);
  for (auto* buffer : {&begin_, &end_}) buffer->fit(room() * sets_);
}

void CellTable::require_room(long owners, long blocks) const {
  const auto require = [](const char* spread, long number, long room) {
    if (number <= room) return;
    throw GpuError(
        fmt::format("gpu: particles have spread {} {} blocks of the grid in a sync period, and there is room "
                    "for {}: shorten time.sync",
                    spread, number, room));
  };
  require("to", owners, owners_room_);
  require("over", blocks, room_);
}

void CellTable::sort(Executor& run, const Places& places, const std::vector<SetView>& sets, Counts counts) {
  find_keys(run, places, sets);
  find_owners(run);
  const bool waits = counts == Counts::waits_for;
  const long owners = waits ? static_cast<long>(flag_.get(particles_)) : owners_room_;
  require_room(owners, 0);
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
    const bool is_first = i == 0 || key[i] / nodes != key[i - 1] / nodes;
    if (is_first && flag[i] < owners) owner[flag[i]] = key[i] / nodes % block_keys;
  });
  if (!waits) {
    std::uint32_t* counted = counts_.data();
    const long particles = particles_;
    run.for_each("gpu: blocks", owners, [=](long i) {
      if (i >= flag[particles]) owner[i] = kNoBlock;
      if (i == 0) counted[0] = flag[particles];
    });
  }
  find_blocks(run, owners, counts);
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

void CellTable::find_owners(Executor& run) {
  run.stable_sort(key_.data(), order_.data(), other_key_.data(), other_order_.data(), particles_,
                  static_cast<std::uint64_t>(sets_) * block_keys_ * per_block_);
  const std::uint64_t *key = key_.data(), nodes = per_block_;
  const long particles = particles_;
  std::uint32_t* flag = flag_.data();
  run.for_each("gpu: blocks", particles + 1,
               [=](long i) { flag[i] = i < particles && (i == 0 || key[i] / nodes != key[i - 1] / nodes) ? 1U : 0U; });
  run.exclusive_scan(flag, flag, particles + 1);  // the last is the number of all
}

void CellTable::find_blocks(Executor& run, long owners, Counts counts) {
  const GridView grid = grid_;
  const int dim = dim_;
  std::uint64_t *key = key_.data(), *block = block_.data();
  const std::uint64_t *owner = owner_.data(), none = block_keys_;
  std::uint32_t* flag = flag_.data();
  const int around = around_;
  const long candidates = owners * around, room = room_;
  run.for_each("gpu: blocks", candidates, [=](long i) {
    const std::uint64_t of = owner[i / around];
    key[i] = of == kNoBlock ? none : neighbour_key(grid, dim, of, static_cast<int>(i % around));
  });
  run.stable_sort(key, order_.data(), other_key_.data(), other_order_.data(), candidates, none + 1);
  run.for_each("gpu: blocks", candidates + 1, [=](long i) {
    flag[i] = i < candidates && key[i] != none && (i == 0 || key[i] != key[i - 1]) ? 1U : 0U;
  });
  run.exclusive_scan(flag, flag, candidates + 1);
  const bool waits = counts == Counts::waits_for;
  blocks_ = waits ? static_cast<long>(flag_.get(candidates)) : room_;
  require_room(0, blocks_);
  run.for_each("gpu: blocks", candidates, [=](long i) {
    if (key[i] != none && (i == 0 || key[i] != key[i - 1]) && flag[i] < room) block[flag[i]] = key[i];
  });
  if (!waits) {
    std::uint32_t* counted = counts_.data();
    run.for_each("gpu: blocks", room, [=](long i) {
      if (i >= flag[candidates]) block[i] = kNoBlock;
      if (i == 0) counted[1] = flag[candidates];
    });
  }
  std::int32_t* neighbours = neighbours_.data();
  const long blocks = blocks_;
  run.for_each("gpu: blocks", blocks * around, [=](long i) {
    const std::uint64_t of = block[i / around];
    neighbours[i] =
        of == kNoBlock ? -1 : place_of(block, blocks, neighbour_key(grid, dim, of, static_cast<int>(i % around)));
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
    const long place = place_of(block, blocks, cell / per_block);
    node[i] = 0;
    if (place < 0) return;  // there was no room for the block, and the run ends
    const long at = place * static_cast<long>(per_block) + static_cast<long>(cell % per_block);
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
  for (const auto* buffer : {&order_, &other_order_, &flag_, &node_, &counts_}) sum += buffer->bytes();
  return sum;
}

}  // namespace mpm_gpu
