#include "mpm/step/sorter.hpp"

#include <algorithm>
#include <array>

#include "mpm/loop/loop.hpp"

namespace mpm {

// The few blocks that particles in sequence lie in, with a value each.
class Sorter::RecentBlocks {
 public:
  struct Entry {
    std::uint64_t key = ~std::uint64_t{0};
    std::uint32_t value = 0;
  };
  Entry& at(std::uint64_t key) { return entries_[(key * 0x9E3779B97F4A7C15ull) >> (64 - kBits)]; }

 private:
  static constexpr int kBits = 8;
  std::array<Entry, std::size_t{1} << kBits> entries_;
};

namespace {

/// Puts the particles of each node in the order of their ids. `node`: of each, in sorted order; `order`: their places.
void take_by_ids(const ParticleSet& set, const std::uint8_t* node, std::uint32_t* order, int threads) {
  const std::size_t owners = set.begin.size() - 1;
  const auto less = [&](std::uint32_t p, std::uint32_t q) { return set.id[p] < set.id[q]; };
  for_all("sort: order by id", threads, owners, [&](std::size_t owner) {
    const std::uint32_t end = set.begin[owner + 1];
    for (std::uint32_t first = set.begin[owner], last = first; first < end; first = last) {
      while (last < end && node[last] == node[first]) ++last;
      if (!std::is_sorted(order + first, order + last, less)) std::sort(order + first, order + last, less);
    }
  });
}

}  // namespace

Sorter::Sorter(int threads, Grouping grouping, NodeChoice* choice)
    : threads_(threads), grouping_(grouping), choice_(choice), parts_(threads) {}

template <int Dim>
std::size_t Sorter::find_blocks(const ParticleSet& set, const GridLayout& layout, Scratch& scratch) {
  const ParticleOrder& before = *scratch.before;
  const std::size_t n = before.count();
  scratch.code.resize(before.end(), scratch.room);
  struct Axis {
    const double* x;
    double lowest, highest;
    std::uint64_t stride;
  };
  std::array<Axis, Dim> axes{};
  // Keys of block (0, 0, 0) in the set's fields.
  std::array<std::uint64_t, 2> corner = {static_cast<std::uint64_t>(set.field) * layout.keys(),
                                         static_cast<std::uint64_t>(set.far_field) * layout.keys()};
  for (int k = 0; k < Dim; ++k) {
    axes[k] = {set.x[k].data(), set.lowest[k], set.highest[k], static_cast<std::uint64_t>(layout.key_stride(k))};
    for (std::uint64_t& key : corner) key += axes[k].stride;
  }
  const std::uint8_t* side = set.side.empty() ? nullptr : set.side.data();
  std::size_t outside = before.end();
  for_all("sort: blocks of particles", threads_, threads_, [&](int t) {
    std::size_t own_outside = before.end();
    RecentBlocks recent;
    std::vector<std::uint64_t>& blocks = parts_[t].blocks;
    before.each_span(part_begin(n, t), part_begin(n, t + 1), [&](std::size_t first, std::size_t end) {
      for (std::size_t p = first; p < end; ++p) {
        std::uint64_t key = corner[side == nullptr ? 0 : side[p]], local = 0;
        bool inside = true;
        for (int k = 0; k < Dim; ++k) {
          const double cells = layout.in_cells(k, axes[k].x[p]);
          inside = inside && cells >= axes[k].lowest && cells <= axes[k].highest;
          const auto node = static_cast<std::uint32_t>(inside ? GridLayout::nearest(cells) : 0);
          key += node / kBlockEdge * axes[k].stride;
          local = local * kBlockEdge + node % kBlockEdge;
        }
        if (!inside) own_outside = std::min(own_outside, p);
        scratch.code[p] = (key << node_bits_) + local;
        RecentBlocks::Entry& entry = recent.at(key);
        if (entry.key != key) {
          entry.key = key;
          blocks.push_back(key);
        }
      }
    });
    in_turn([&] { outside = std::min(outside, own_outside); });
  });
  return outside;
}

void Sorter::collect_owners(const GridLayout& layout) {
  owner_keys_.clear();
  for (Part& part : parts_) {
    std::sort(part.blocks.begin(), part.blocks.end());
    part.blocks.erase(std::unique(part.blocks.begin(), part.blocks.end()), part.blocks.end());
    owner_keys_.insert(owner_keys_.end(), part.blocks.begin(), part.blocks.end());
    // Fields have the blocks of those who choose from them.
    for (const std::uint64_t key : part.blocks) {
      if (choice_ == nullptr || key < choice_->number() * layout.keys()) continue;
      for (const int field : choice_->chosen()) {
        owner_keys_.push_back(key - (choice_->number() - field) * layout.keys());
      }
    }
  }
  std::sort(owner_keys_.begin(), owner_keys_.end());
  owner_keys_.erase(std::unique(owner_keys_.begin(), owner_keys_.end()), owner_keys_.end());
}

void Sorter::sort_by_block(ParticleSet& set, Scratch& scratch) {
  const ParticleOrder& before = *scratch.before;
  const std::size_t n = before.count(), owners = owner_keys_.size();
  const std::uint64_t node_mask = (std::uint64_t{1} << node_bits_) - 1;
  for_all("sort: particles of blocks", threads_, threads_, [&](int t) {
    RecentBlocks recent;
    std::vector<std::uint32_t>& count = parts_[t].next;
    count.assign(owners, 0);
    before.each_span(part_begin(n, t), part_begin(n, t + 1), [&](std::size_t first, std::size_t end) {
      for (std::size_t p = first; p < end; ++p) {
        const std::uint64_t code = scratch.code[p], key = code >> node_bits_;
        RecentBlocks::Entry& entry = recent.at(key);
        if (entry.key != key) {
          entry.key = key;
          const auto found = std::lower_bound(owner_keys_.begin(), owner_keys_.end(), key);
          entry.value = static_cast<std::uint32_t>(found - owner_keys_.begin());
        }
        scratch.code[p] = (std::uint64_t{entry.value} << node_bits_) + (code & node_mask);
        ++count[entry.value];
      }
    });
  });

  set.begin.resize(owners + 1);
  std::uint32_t sum = 0;
  for (std::size_t o = 0; o < owners; ++o) {
    set.begin[o] = sum;
    for (Part& part : parts_) {
      const std::uint32_t count = part.next[o];
      part.next[o] = sum;
      sum += count;
    }
  }
  set.begin[owners] = sum;

  scratch.order.resize(n, scratch.room);
  for_all("sort: order by block", threads_, threads_, [&](int t) {
    std::vector<std::uint32_t>& next = parts_[t].next;
    before.each_span(part_begin(n, t), part_begin(n, t + 1), [&](std::size_t first, std::size_t end) {
      for (std::size_t p = first; p < end; ++p) {
        scratch.order[next[scratch.code[p] >> node_bits_]++] = static_cast<std::uint32_t>(p);
      }
    });
  });
}

void Sorter::sort_by_node(ParticleSet& set, Scratch& scratch) {
  const std::size_t owners = owner_keys_.size();
  const std::uint64_t node_mask = (std::uint64_t{1} << node_bits_) - 1;
  const std::uint32_t lanes = static_cast<std::uint32_t>(grouping_.lanes);
  const std::size_t span = grouping_.by == Grouping::By::column ? kBlockEdge : 1;  // nodes that may share a group
  scratch.node.resize(scratch.before->count(), scratch.room);
  set.group_begin.resize(owners + 1);
  for_parts("sort: order by node", threads_, owners, [&](std::size_t first_owner, std::size_t end, int thread) {
    std::vector<std::uint32_t>& sorted = parts_[thread].order;
    for (std::size_t o = first_owner; o < end; ++o) {
      const std::uint32_t begin = set.begin[o], count = set.begin[o + 1] - begin;
      std::uint32_t* order = scratch.order.data() + begin;
      std::uint8_t* node = scratch.node.data() + begin;
      std::array<std::uint32_t, 65> first{};
      for (std::uint32_t i = 0; i < count; ++i) {
        node[i] = static_cast<std::uint8_t>(scratch.code[order[i]] & node_mask);
        ++first[node[i] + 1];
      }
      std::uint32_t groups = 0;
      for (std::size_t m = 0; m <= node_mask; m += span) {
        std::uint32_t together = 0;
        for (std::size_t k = m; k < m + span; ++k) together += first[k + 1];
        groups += (together + lanes - 1) / lanes;
      }
      set.group_begin[o] = groups;
      for (std::size_t m = 0; m <= node_mask; ++m) first[m + 1] += first[m];
      if (sorted.size() < count) sorted.resize(count);
      std::array<std::uint32_t, 64> next;
      std::copy_n(first.begin(), 64, next.begin());
      for (std::uint32_t i = 0; i < count; ++i) sorted[next[node[i]]++] = order[i];
      std::copy_n(sorted.begin(), count, order);
      for (std::size_t m = 0; m <= node_mask; ++m) {
        std::fill(node + first[m], node + first[m + 1], static_cast<std::uint8_t>(m));
      }
    }
  });
  std::uint32_t sum = 0;
  for (std::size_t o = 0; o < owners; ++o) {
    const std::uint32_t groups = set.group_begin[o];
    set.group_begin[o] = sum;
    sum += groups;
  }
  set.group_begin[owners] = sum;
}

void Sorter::fill_groups(ParticleSet& set, const Scratch& scratch) const {
  const std::size_t owners = owner_keys_.size();
  const std::uint32_t lanes = static_cast<std::uint32_t>(grouping_.lanes);
  static_assert(kBlockEdge == 4);
  const int shift = grouping_.by == Grouping::By::column ? 2 : 0;
  set.group.resize(set.group_begin[owners] + 1);
  for_all("sort: groups", threads_, owners, [&](std::size_t o) {
    std::uint32_t* group = set.group.data() + set.group_begin[o];
    const std::uint32_t begin = set.begin[o], end = set.begin[o + 1];
    int last = -1;  // place of the particles of the current group
    for (std::uint32_t first = begin, p = begin; p < end; ++p) {
      const int place = scratch.node[p] >> shift;
      if (place == last && p - first < lanes) continue;
      *group++ = first = p;
      last = place;
    }
  });
  set.group.back() = static_cast<std::uint32_t>(scratch.before->count());
}

void Sorter::rebuild(const std::vector<ParticleSet>& sets, Fields& fields) {
  auto first = owner_keys_.begin();
  std::uint64_t corner = 0;  // key 0 of the field
  for (auto& field : fields) {
    const std::uint64_t next = corner + field->layout.keys();
    const auto end = std::lower_bound(first, owner_keys_.end(), next);
    field_keys_.assign(first, end);
    for (std::uint64_t& key : field_keys_) key -= corner;
    field->first_owner = static_cast<int>(first - owner_keys_.begin());
    field_particles_.assign(field_keys_.size(), 0);
    for (const ParticleSet& set : sets) {
      const std::uint32_t* begin = set.begin.data() + field->first_owner;
      for (std::size_t o = 0; o < field_particles_.size(); ++o) field_particles_[o] += begin[o + 1] - begin[o];
    }
    field->rebuild(field_keys_, threads_, field_particles_);
    first = end;
    corner = next;
  }
  if (choice_ == nullptr) return;
  std::vector<std::uint64_t> keys(first, owner_keys_.end());
  for (std::uint64_t& key : keys) key -= corner;
  choice_->set_blocks(std::move(keys), static_cast<int>(first - owner_keys_.begin()));
}

std::optional<ParticleRef> Sorter::sort(std::vector<ParticleSet>& sets, Fields& fields,
                                        const std::vector<ParticleOrder>* orders) {
  static_assert(kBlockEdge == 4);
  const GridLayout& layout = fields.front()->layout;
  const int dim = layout.dim();
  node_bits_ = 2 * static_cast<unsigned>(dim);
  scratch_.resize(sets.size());
  for (Part& part : parts_) part.blocks.clear();
  for (std::size_t s = 0; s < sets.size(); ++s) {
    Scratch& scratch = scratch_[s];
    if (orders == nullptr) scratch.in_memory.be_as_in_memory(sets[s]);
    scratch.before = orders == nullptr ? &scratch.in_memory : &(*orders)[s];
    scratch.room = orders == nullptr ? 0 : room_for_particles(scratch.before->count());
    const std::size_t outside = dim == 3   ? find_blocks<3>(sets[s], layout, scratch)
                                : dim == 2 ? find_blocks<2>(sets[s], layout, scratch)
                                           : find_blocks<1>(sets[s], layout, scratch);
    if (outside < scratch.before->end()) return ParticleRef{static_cast<int>(s), static_cast<int>(outside)};
  }
  collect_owners(layout);
  for (std::size_t s = 0; s < sets.size(); ++s) {
    Scratch& scratch = scratch_[s];
    sort_by_block(sets[s], scratch);
    sort_by_node(sets[s], scratch);
    if (sets[s].sorts_by_id) take_by_ids(sets[s], scratch.node.data(), scratch.order.data(), threads_);
    fill_groups(sets[s], scratch);
    permute(sets[s], scratch.order.data(), *scratch.before, scratch.room, scratch.values, threads_);
  }
  rebuild(sets, fields);
  return std::nullopt;
}

}  // namespace mpm
