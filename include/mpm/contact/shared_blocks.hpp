// Blocks of the grid that two or more velocity fields have in use: bodies can meet there and nowhere else. Found anew
// only when particles have been sorted; a block has the same key in every field.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/grid/fields.hpp"

namespace mpm {

/// A block by its place in each field that has it.
struct SharedBlock {
  struct Part {
    int field, block;
  };
  std::uint64_t key = 0;
  std::vector<Part> parts;  ///< fields ascending
};

class SharedBlocks {
 public:
  /// Looks again if a field's blocks have changed; returns whether it did. `meet(a, b)`: whether fields a < b act on
  /// each other.
  template <class Meet>
  bool update(const Fields& fields, Meet&& meet) {
    if (!changed(fields)) return false;
    std::vector<std::size_t> next(fields.size(), 0);
    list_.clear();
    for (;;) {
      SharedBlock block;
      bool any = false;
      for (std::size_t f = 0; f < fields.size(); ++f) {
        const BlockTable& blocks = fields[f]->blocks;
        if (static_cast<int>(next[f]) == blocks.size()) continue;
        const std::uint64_t key = blocks.key(static_cast<int>(next[f]));
        if (any && key > block.key) continue;
        if (!any || key < block.key) block = {key, {}};
        any = true;
        block.parts.push_back({static_cast<int>(f), static_cast<int>(next[f])});
      }
      if (!any) break;
      for (const SharedBlock::Part& part : block.parts) ++next[part.field];
      if (any_meet(block, meet)) list_.push_back(std::move(block));
    }
    mark(fields);
    return true;
  }

  /// In ascending order of key.
  const std::vector<SharedBlock>& list() const { return list_; }
  /// One mark for each block of a field, set where the block is shared.
  const std::vector<std::uint8_t>& marks(int field) const { return marks_[field]; }
  bool any(int field) const { return any_[field] != 0; }

 private:
  template <class Meet>
  static bool any_meet(const SharedBlock& block, Meet& meet) {
    for (std::size_t i = 0; i < block.parts.size(); ++i) {
      for (std::size_t k = i + 1; k < block.parts.size(); ++k) {
        if (meet(block.parts[i].field, block.parts[k].field)) return true;
      }
    }
    return false;
  }
  bool changed(const Fields& fields);
  void mark(const Fields& fields);

  std::vector<SharedBlock> list_;
  std::vector<std::uint64_t> generations_;
  std::vector<std::vector<std::uint8_t>> marks_;
  std::vector<std::uint8_t> any_;
};

}  // namespace mpm
