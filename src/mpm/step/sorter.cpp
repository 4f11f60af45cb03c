#include "mpm/step/sorter.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

namespace mpm {

void Sorter::radix_sort(std::vector<Entry>& entries) {
  if (entries.size() < 2) return;
  std::uint64_t low = entries[0].key, high = entries[0].key;
  for (const Entry& e : entries) {
    low = std::min(low, e.key);
    high = std::max(high, e.key);
  }
  constexpr int kBits = 11;
  constexpr std::uint64_t kMask = (1u << kBits) - 1;
  other_.resize(entries.size());
  for (int shift = 0; shift < 64 && ((high - low) >> shift) != 0; shift += kBits) {
    std::array<std::uint32_t, kMask + 1> start{};
    for (const Entry& e : entries) ++start[((e.key - low) >> shift) & kMask];
    std::uint32_t sum = 0;
    for (std::uint32_t& s : start) {
      const std::uint32_t count = s;
      s = sum;
      sum += count;
    }
    for (const Entry& e : entries) other_[start[((e.key - low) >> shift) & kMask]++] = e;
    entries.swap(other_);
  }
}

void Sorter::permute(ParticleSet& set, const std::vector<Entry>& entries) {
  const int n = set.size();
  const auto reorder = [&](auto& values, auto& scratch) {
    scratch.resize(n);
#pragma omp parallel for schedule(static) num_threads(threads_)
    for (int i = 0; i < n; ++i) scratch[i] = values[entries[i].index];
    values.swap(scratch);
  };
  set.each_scalar([&](auto& values) {
    if constexpr (std::is_same_v<std::decay_t<decltype(values[0])>, double>) {
      reorder(values, scratch_);
    } else {
      reorder(values, float_scratch_);
    }
  });
  reorder(set.id, id_scratch_);
}

void Sorter::find_groups(ParticleSet& set, const std::vector<Entry>& entries) const {
  const std::uint64_t span = grouping_.by == Grouping::By::column ? kBlockEdge : 1;
  const std::uint32_t most = static_cast<std::uint32_t>(grouping_.lanes);
  const std::size_t owners = set.begin.size() - 1;
  set.group.clear();
  set.group_begin.resize(owners + 1);
  for (std::size_t o = 0; o < owners; ++o) {
    set.group_begin[o] = static_cast<std::uint32_t>(set.group.size());
    for (std::uint32_t first = set.begin[o], p = first; p < set.begin[o + 1]; ++p) {
      if (p == set.begin[o] || p - first == most || entries[p].key / span != entries[first].key / span) {
        set.group.push_back(first = p);
      }
    }
  }
  set.group_begin[owners] = static_cast<std::uint32_t>(set.group.size());
  set.group.push_back(static_cast<std::uint32_t>(set.size()));
}

std::optional<ParticleRef> Sorter::sort(std::vector<ParticleSet>& sets, Grid& grid) {
  const GridLayout& layout = grid.layout;
  const int dim = layout.dim();
  entries_.resize(sets.size());
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const ParticleSet& set = sets[s];
    const int n = set.size();
    std::vector<Entry>& entries = entries_[s];
    entries.resize(n);
    int outside = n;
#pragma omp parallel for schedule(static) num_threads(threads_) reduction(min : outside)
    for (int i = 0; i < n; ++i) {
      std::array<int, 3> block{};
      std::uint32_t local = 0;
      bool inside = true;
      for (int k = 0; k < dim; ++k) {
        const double cells = layout.in_cells(k, set.x[k][i]);
        inside = inside && cells >= set.lowest[k] && cells <= set.highest[k];
        const int node = inside ? GridLayout::nearest(cells) : 0;
        block[k] = node / kBlockEdge;
        local = local * kBlockEdge + node % kBlockEdge;
      }
      if (!inside) outside = std::min(outside, i);
      entries[i] = {layout.key(block) * layout.nodes_per_block() + local, static_cast<std::uint32_t>(i)};
    }
    if (outside < n) return ParticleRef{static_cast<int>(s), outside};
  }

  owner_keys_.clear();
  for (std::size_t s = 0; s < sets.size(); ++s) {
    std::vector<Entry>& entries = entries_[s];
    radix_sort(entries);
    permute(sets[s], entries);
    std::uint64_t last = ~std::uint64_t{0};
    for (const Entry& e : entries) {
      const std::uint64_t block = e.key / layout.nodes_per_block();
      if (block != last) owner_keys_.push_back(last = block);
    }
  }
  std::sort(owner_keys_.begin(), owner_keys_.end());
  owner_keys_.erase(std::unique(owner_keys_.begin(), owner_keys_.end()), owner_keys_.end());

  for (std::size_t s = 0; s < sets.size(); ++s) {
    std::vector<std::uint32_t>& begin = sets[s].begin;
    begin.resize(owner_keys_.size() + 1);
    std::uint32_t next = 0;
    const std::vector<Entry>& entries = entries_[s];
    for (std::size_t o = 0; o < owner_keys_.size(); ++o) {
      begin[o] = next;
      while (next < entries.size() && entries[next].key / layout.nodes_per_block() == owner_keys_[o]) ++next;
    }
    begin[owner_keys_.size()] = next;
    find_groups(sets[s], entries);
  }
  grid.rebuild(owner_keys_);
  return std::nullopt;
}

}  // namespace mpm
