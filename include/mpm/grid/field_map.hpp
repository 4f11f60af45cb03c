// Choice of the velocity field that material belongs to: a map from a body and a side to the number of a field
// (grid/fields.hpp). Bodies of one group share a velocity, so they share a field. A body that a thin tool divides has a
// second field, for its material on side 1. A body that cracks divide has more of them, for what lies across a crack
// or a thin tool from a node; a particle of it may spread to several (grid/node_choice.hpp). The other bodies have one.
#pragma once

#include <array>
#include <vector>

namespace mpm {

class FieldMap {
 public:
  FieldMap() = default;
  /// `groups`: of each body, counted from 0. `divided`: of each body, whether something divides it.
  /// `across`: of each body, how many fields there are for material across cracks; empty: none.
  FieldMap(const std::vector<int>& groups, const std::vector<bool>& divided, const std::vector<int>& across = {});

  /// Number of fields; one at least.
  int count() const { return static_cast<int>(side_.size()); }
  /// Field of the material of `body` on `side`, 0 or 1; of a body that nothing divides, side 0 is meant always.
  int field(int body, int side = 0) const { return fields_[body][divided(body) ? side : 0]; }
  bool divided(int body) const { return fields_[body][0] != fields_[body][1]; }
  /// Number of fields for material of a body across cracks; they follow field(body).
  int across(int body) const { return across_[body]; }
  /// The fields of all bodies that cracks divide, ascending: those that particles choose from.
  std::vector<int> chosen() const;
  /// Fields that hold material of a body.
  std::vector<int> fields(int body) const;
  /// Side whose material a field holds; 0 where nothing is divided.
  int side(int field) const { return side_[field]; }
  /// True if a field holds the material of one side alone.
  bool one_sided(int field) const;
  /// The fields of side 0 and side 1 of every group that is divided.
  const std::vector<std::array<int, 2>>& divisions() const { return divisions_; }

 private:
  std::vector<std::array<int, 2>> fields_;  ///< fields of each body, by side; the same twice where nothing divides it
  std::vector<int> across_;                 ///< fields across cracks of each body
  std::vector<std::array<int, 2>> divisions_;
  std::vector<int> side_{0};  ///< side of each field
};

}  // namespace mpm
