#include "mpm/grid/field_map.hpp"

#include <algorithm>

namespace mpm {

FieldMap::FieldMap(const std::vector<int>& groups, const std::vector<bool>& divided, const std::vector<int>& across) {
  const int count = groups.empty() ? 1 : 1 + *std::max_element(groups.begin(), groups.end());
  std::vector<bool> in_two(count, false);
  std::vector<int> more(count, 0);
  for (std::size_t b = 0; b < groups.size(); ++b) {
    if (divided[b]) in_two[groups[b]] = true;
    across_.push_back(across.empty() ? 0 : across[b]);
    more[groups[b]] = std::max(more[groups[b]], across_[b]);
  }
  side_.clear();
  std::vector<int> first(count);
  for (int g = 0; g < count; ++g) {
    first[g] = static_cast<int>(side_.size());
    side_.insert(side_.end(), 1 + more[g], 0);
    if (!in_two[g]) continue;
    side_.push_back(1);
    divisions_.push_back({first[g], static_cast<int>(side_.size()) - 1});
  }
  for (std::size_t b = 0; b < groups.size(); ++b) {
    const int own = first[groups[b]];
    fields_.push_back({own, divided[b] ? own + more[groups[b]] + 1 : own});
  }
}

bool FieldMap::one_sided(int field) const {
  return std::any_of(divisions_.begin(), divisions_.end(),
                     [&](const std::array<int, 2>& pair) { return pair[0] == field || pair[1] == field; });
}

std::vector<int> FieldMap::fields(int body) const {
  std::vector<int> list{fields_[body][0]};
  for (int f = 1; f <= across_[body]; ++f) list.push_back(list.front() + f);
  if (divided(body)) list.push_back(fields_[body][1]);
  return list;
}

std::vector<int> FieldMap::chosen() const {
  std::vector<int> list;
  for (std::size_t b = 0; b < across_.size(); ++b) {
    for (int f = 0; f <= across_[b] && across_[b] > 0; ++f) list.push_back(fields_[b][0] + f);
  }
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

}  // namespace mpm
