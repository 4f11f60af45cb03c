#include "mpm/step/patch_sorter.hpp"

#include <algorithm>
#include <type_traits>

namespace mpm {
namespace {

constexpr std::uint32_t kTileNodes = NodeChoice::kTileNodes;

/// Nearest node of a particle in the tile of its patch's block, the last axis fastest.
std::uint32_t tile_node(const ParticleSet& set, const GridLayout& layout, const std::array<int, 3>& block,
                        std::size_t p) {
  std::uint32_t at = 0;
  for (int k = 0; k < layout.dim(); ++k) {
    const int node = GridLayout::nearest(layout.in_cells(k, set.x[k][p])) - block[k] * kBlockEdge + NodeChoice::kMargin;
    at = at * NodeChoice::kEdge + static_cast<std::uint32_t>(std::clamp(node, 0, NodeChoice::kEdge - 1));
  }
  return at;
}

}  // namespace

void PatchSorter::look_at(const std::vector<ParticleSet>& sets, const NodeChoice& choice) {
  begin_.resize(sets.size());
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const auto first = sets[s].begin.begin() + choice.grid().first_owner;
    begin_[s].assign(first, first + static_cast<std::ptrdiff_t>(choice.blocks().size()) + 1);
  }
  generation_ = choice.sorted();
}

void PatchSorter::sort(std::size_t number, ParticleSet& set, const NodeChoice& choice, const std::vector<int>& patch) {
  const Grid& grid = choice.grid();
  const std::uint32_t first = begin_[number].front(), patches = static_cast<std::uint32_t>(choice.patches());
  const std::size_t count = patch.size();
  const std::uint32_t together = grouping_.by == Grouping::By::column ? NodeChoice::kEdge : 1;
  key_.resize(count);
  bool sorted = true;
  for (std::size_t i = 0; i < count; ++i) {
    const std::array<int, 3>& block = grid.blocks.block(grid.blocks.owner_block(patch[i]));
    key_[i] = static_cast<std::uint32_t>(patch[i]) * kTileNodes + tile_node(set, grid.layout, block, first + i);
    sorted = sorted && (i == 0 || key_[i - 1] / together <= key_[i] / together);
  }
  if (!sorted) {
    next_.assign(patches * kTileNodes + 1, 0);
    for (const std::uint32_t key : key_) ++next_[key + 1];
    for (std::size_t k = 1; k < next_.size(); ++k) next_[k] += next_[k - 1];
    order_.resize(count);
    for (std::size_t i = 0; i < count; ++i) order_[next_[key_[i]]++] = static_cast<std::uint32_t>(i);
    permute(set, first, count);
    std::sort(key_.begin(), key_.end());
  }

  set.begin.resize(grid.first_owner + patches + 1);
  set.group_begin.resize(grid.first_owner + patches + 1);
  set.group.resize(set.group_begin[grid.first_owner]);
  std::size_t i = 0;
  for (std::uint32_t n = 0; n < patches; ++n) {
    set.begin[grid.first_owner + n] = first + static_cast<std::uint32_t>(i);
    set.group_begin[grid.first_owner + n] = static_cast<std::uint32_t>(set.group.size());
    std::size_t group = i;
    for (; i < count && key_[i] / kTileNodes == n; ++i) {
      const bool joins = i > group && key_[i] / together == key_[group] / together &&
                         i - group < static_cast<std::size_t>(grouping_.lanes);
      if (joins) continue;
      set.group.push_back(first + static_cast<std::uint32_t>(i));
      group = i;
    }
  }
  set.begin.back() = static_cast<std::uint32_t>(set.awake());
  set.group_begin.back() = static_cast<std::uint32_t>(set.group.size());
  set.group.push_back(static_cast<std::uint32_t>(set.awake()));
}

void PatchSorter::permute(ParticleSet& set, std::uint32_t first, std::size_t count) {
  const auto reorder = [&](auto& values, auto& other) {
    other.resize(count);
    for (std::size_t i = 0; i < count; ++i) other[i] = values[first + order_[i]];
    std::copy(other.begin(), other.end(), values.data() + first);
  };
  set.each_scalar([&](auto& values) {
    if constexpr (std::is_same_v<std::decay_t<decltype(values[0])>, double>) {
      reorder(values, doubles_);
    } else {
      reorder(values, floats_);
    }
  });
  reorder(set.id, ids_);
  reorder(set.side, sides_);
}

void PatchSorter::serialise(StateArchive& archive, NodeChoice& choice) {
  std::vector<std::uint64_t> keys = choice.blocks();
  int first_owner = choice.grid().first_owner;
  archive.list("blocks", keys);
  archive.sum("first_owner", first_owner);  // each rank has its own
  std::uint64_t since = choice.sorted() - generation_;
  archive.sum("sorts_since", since);
  if (archive.merging()) return;  // sorted anew
  if (archive.reading()) {
    choice.set_blocks(std::move(keys), first_owner);
    generation_ = choice.sorted() - since;
  }
  for (std::size_t s = 0; s < begin_.size(); ++s) archive.list("begin_" + std::to_string(s), begin_[s]);
}

}  // namespace mpm
