#include "mpm/ranks/territory.hpp"

#include <algorithm>

#include "mpm/ranks/hilbert.hpp"

namespace mpm {
namespace {

constexpr int kBefore = 1;  ///< blocks before the domain's first along an axis, which particles at a face reach

}  // namespace

Territory::Territory(const GridLayout& layout, int parts) : layout_(layout), bits_(1), cuts_(parts + 1) {
  int most = 0;
  for (int k = 0; k < layout.dim(); ++k) most = std::max(most, layout.last_node(k) / kBlockEdge + 2 + kBefore);
  while (1 << bits_ <= most) ++bits_;
  for (int r = 1; r <= parts; ++r) cuts_[r] = std::uint64_t{1} << (layout.dim() * bits_);
}

std::uint64_t Territory::place(std::uint64_t key) const {
  const std::array<int, 3> block = layout_.block(key);
  std::array<std::uint32_t, 3> at{};
  for (int k = 0; k < layout_.dim(); ++k) at[k] = static_cast<std::uint32_t>(std::max(block[k] + kBefore, 0));
  return hilbert_index(at, layout_.dim(), bits_);
}

int Territory::owner(std::uint64_t key) const {
  const auto [known, added] = known_.try_emplace(key, 0);
  if (!added) return known->second;
  const auto cut = std::upper_bound(cuts_.begin() + 1, cuts_.end() - 1, place(key));
  known->second = static_cast<int>(cut - cuts_.begin()) - 1;
  return known->second;
}

void Territory::cut(const Load& load, const Sum& sum) {
  std::vector<std::pair<std::uint64_t, double>> along;  // by place, particles up to and with it
  along.reserve(load.size());
  for (const auto& [key, particles] : load) along.emplace_back(place(key), static_cast<double>(particles));
  std::sort(along.begin(), along.end());
  double all = 0.0;
  for (auto& entry : along) entry.second = all += entry.second;
  sum(&all, 1);
  if (!(all > 0.0)) return;  // nothing to share out: the cuts stay

  // Bisection for all cuts at once: the least place before which a rank's share lies.
  const int inner = parts() - 1;
  std::vector<std::uint64_t> low(inner, 0), high(inner, cuts_.back());
  std::vector<double> before(inner);
  for (int bit = 0; bit <= layout_.dim() * bits_ && inner > 0; ++bit) {
    for (int c = 0; c < inner; ++c) {
      const std::uint64_t middle = low[c] + (high[c] - low[c]) / 2;
      const auto next = std::lower_bound(along.begin(), along.end(), std::pair{middle, 0.0});
      before[c] = next == along.begin() ? 0.0 : std::prev(next)->second;
    }
    sum(before.data(), inner);
    for (int c = 0; c < inner; ++c) {
      const std::uint64_t middle = low[c] + (high[c] - low[c]) / 2;
      if (before[c] * parts() < all * (c + 1)) {
        low[c] = std::min(middle + 1, high[c]);
      } else {
        high[c] = middle;
      }
    }
  }
  std::copy(high.begin(), high.end(), cuts_.begin() + 1);
  known_.clear();
}

}  // namespace mpm
