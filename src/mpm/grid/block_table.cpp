#include "mpm/grid/block_table.hpp"

#include <algorithm>
#include <iterator>

#include "mpm/loop/loop.hpp"

namespace mpm {

int BlockTable::find(std::uint64_t key) const {
  const auto it = std::lower_bound(keys_.begin(), keys_.end(), key);
  return it != keys_.end() && *it == key ? static_cast<int>(it - keys_.begin()) : -1;
}

// Adds to keys_ the neighbours of each block along one axis: three ascending lists become one.
void BlockTable::widen(std::uint64_t stride) {
  wider_.clear();
  const std::size_t n = keys_.size();
  std::size_t above = 0, here = 0, below = 0;  // next entry of the lists key + stride, key, key - stride
  while (above < n) {
    std::uint64_t least = keys_[above] + stride;
    if (here < n) least = std::min(least, keys_[here]);
    if (below < n) least = std::min(least, keys_[below] - stride);
    above += keys_[above] + stride == least;
    here += here < n && keys_[here] == least;
    below += below < n && keys_[below] - stride == least;
    wider_.push_back(least);
  }
  keys_.swap(wider_);
}

// Owners and blocks are both in ascending order, and so are the neighbours on one side of all owners.
void BlockTable::find_neighbours(const std::vector<std::uint64_t>& owner_keys, std::size_t begin, std::size_t end) {
  for (int s = 0; s < span_; ++s) {
    auto block = std::lower_bound(keys_.begin(), keys_.end(), owner_keys[begin] + offset_[s]);
    for (std::size_t o = begin; o < end; ++o) {
      const std::uint64_t key = owner_keys[o] + offset_[s];
      while (*block < key) ++block;
      neighbours_[o * span_ + s] = static_cast<int>(block - keys_.begin());
    }
  }
  for (std::size_t o = begin; o < end; ++o) owner_block_[o] = neighbours_[o * span_ + span_ / 2];
}

void BlockTable::wrap_blocks() {
  for (std::uint64_t& key : keys_) key = layout_->key(layout_->block(key));
  std::sort(keys_.begin(), keys_.end());
  keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
}

// With periodic axes the neighbours are in no order, so each is looked up.
void BlockTable::find_wrapped_neighbours(const std::vector<std::uint64_t>& owner_keys, std::size_t begin,
                                         std::size_t end) {
  for (std::size_t o = begin; o < end; ++o) {
    const std::array<int, 3> owner = layout_->block(owner_keys[o]);
    for (int s = 0; s < span_; ++s) {
      neighbours_[o * span_ + s] = find(layout_->key(neighbour_of(owner, s, layout_->dim())));
    }
    owner_block_[o] = neighbours_[o * span_ + span_ / 2];
  }
}

void BlockTable::rebuild(const std::vector<std::uint64_t>& owner_keys, int threads) {
  const int dim = layout_->dim();
  span_ = neighbours_of(dim);
  for (int s = 0; s < span_; ++s) {
    const std::array<int, 3> step = neighbour_of({}, s, dim);
    offset_[s] = 0;
    for (int k = 0; k < dim; ++k) offset_[s] += static_cast<std::uint64_t>(step[k] * layout_->key_stride(k));
  }

  keys_ = owner_keys;
  for (int k = dim - 1; k >= 0; --k) widen(static_cast<std::uint64_t>(layout_->key_stride(k)));
  if (layout_->any_periodic()) wrap_blocks();

  coordinates_.resize(keys_.size());
  for_all("grid: places of blocks", threads, keys_.size(),
          [&](std::size_t i) { coordinates_[i] = layout_->block(keys_[i]); });

  const std::size_t owners = owner_keys.size();
  owner_block_.resize(owners);
  neighbours_.resize(owners * span_);
  for_parts("grid: neighbours of blocks", threads, owners, [&](std::size_t begin, std::size_t end, int) {
    if (layout_->any_periodic()) {
      find_wrapped_neighbours(owner_keys, begin, end);
    } else {
      find_neighbours(owner_keys, begin, end);
    }
  });

  for (auto& colour : colours_) colour.clear();
  for (std::size_t o = 0; o < owners; ++o) {
    const std::array<int, 3>& c = coordinates_[owner_block_[o]];
    int colour = 0;
    for (int k = 0; k < dim; ++k) colour = 2 * colour + (c[k] & 1);
    colours_[colour].push_back(static_cast<int>(o));
  }
  ++generation_;
}

void BlockTable::admit(const std::vector<std::uint64_t>& keys) {
  if (keys.empty()) return;
  wider_.clear();
  std::merge(keys_.begin(), keys_.end(), keys.begin(), keys.end(), std::back_inserter(wider_));
  std::vector<int> moved(keys_.size());
  std::size_t to = 0;
  for (std::size_t from = 0; from < keys_.size(); ++from, ++to) {
    while (wider_[to] != keys_[from]) ++to;
    moved[from] = static_cast<int>(to);
  }
  keys_.swap(wider_);
  for (int& block : owner_block_) block = moved[block];
  for (int& block : neighbours_) block = moved[block];
  coordinates_.resize(keys_.size());
  for (std::size_t i = 0; i < keys_.size(); ++i) coordinates_[i] = layout_->block(keys_[i]);
}

void BlockTable::rebuild_apart(const std::vector<std::uint64_t>& owner_keys) {
  span_ = neighbours_of(layout_->dim());
  const std::size_t owners = owner_keys.size(), blocks = owners * span_;
  keys_.resize(blocks);
  coordinates_.resize(blocks);
  neighbours_.resize(blocks);
  owner_block_.resize(owners);
  for (auto& colour : colours_) colour.clear();
  for (std::size_t o = 0; o < owners; ++o) {
    for (int s = 0; s < span_; ++s) {
      const std::size_t block = o * span_ + s;
      keys_[block] = owner_keys[o];
      coordinates_[block] = layout_->block(owner_keys[o]);  // that of the owner is what is asked for
      neighbours_[block] = static_cast<int>(block);
    }
    owner_block_[o] = static_cast<int>(o * span_ + span_ / 2);
    colours_[0].push_back(static_cast<int>(o));
  }
  ++generation_;
}

}  // namespace mpm
