#include "mpm/grid/block_table.hpp"

#include <algorithm>

namespace mpm {

int BlockTable::find(std::uint64_t key) const {
  const auto it = std::lower_bound(keys_.begin(), keys_.end(), key);
  return it != keys_.end() && *it == key ? static_cast<int>(it - keys_.begin()) : -1;
}

void BlockTable::rebuild(const std::vector<std::uint64_t>& owner_keys) {
  const int dim = layout_->dim();
  span_ = dim == 3 ? 27 : 9;
  std::array<std::int64_t, 27> offset{};
  for (int s = 0; s < span_; ++s) {
    int rest = s;
    for (int k = dim - 1; k >= 0; --k) {
      offset[s] += (rest % 3 - 1) * layout_->key_stride(k);
      rest /= 3;
    }
  }

  keys_.clear();
  for (const std::uint64_t key : owner_keys) {
    for (int s = 0; s < span_; ++s) keys_.push_back(key + static_cast<std::uint64_t>(offset[s]));
  }
  std::sort(keys_.begin(), keys_.end());
  keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());

  coordinates_.resize(keys_.size());
  for (std::size_t i = 0; i < keys_.size(); ++i) coordinates_[i] = layout_->block(keys_[i]);

  owner_block_.resize(owner_keys.size());
  neighbours_.resize(owner_keys.size() * span_);
  for (auto& colour : colours_) colour.clear();
  for (std::size_t o = 0; o < owner_keys.size(); ++o) {
    for (int s = 0; s < span_; ++s) {
      neighbours_[o * span_ + s] = find(owner_keys[o] + static_cast<std::uint64_t>(offset[s]));
    }
    owner_block_[o] = neighbours_[o * span_ + span_ / 2];
    const std::array<int, 3>& c = coordinates_[owner_block_[o]];
    int colour = 0;
    for (int k = 0; k < dim; ++k) colour = 2 * colour + (c[k] & 1);
    colours_[colour].push_back(static_cast<int>(o));
  }
  ++generation_;
}

}  // namespace mpm
