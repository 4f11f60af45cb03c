#include "mpm/grid/field_map.hpp"

#include <algorithm>

namespace mpm {

FieldMap::FieldMap(const std::vector<int>& groups, const std::vector<bool>& divided) {
  const int count = groups.empty() ? 1 : 1 + *std::max_element(groups.begin(), groups.end());
  std::vector<bool> in_two(count, false);
  for (std::size_t b = 0; b < groups.size(); ++b) {
    if (divided[b]) in_two[groups[b]] = true;
  }
  side_.clear();
  std::vector<int> first(count);
  for (int g = 0; g < count; ++g) {
    first[g] = static_cast<int>(side_.size());
    side_.push_back(0);
    if (!in_two[g]) continue;
    side_.push_back(1);
    divisions_.push_back({first[g], first[g] + 1});
  }
  for (std::size_t b = 0; b < groups.size(); ++b) {
    const int own = first[groups[b]];
    fields_.push_back({own, divided[b] ? own + 1 : own});
  }
}

bool FieldMap::one_sided(int field) const {
  return std::any_of(divisions_.begin(), divisions_.end(),
                     [&](const std::array<int, 2>& pair) { return pair[0] == field || pair[1] == field; });
}

std::vector<int> FieldMap::fields(int body) const {
  if (!divided(body)) return {fields_[body][0]};
  return {fields_[body][0], fields_[body][1]};
}

}  // namespace mpm
