// The blocks of the grid in use. An owner is a block that holds particles; the blocks in use are the owners and their
// neighbours, in ascending order of their keys. They are rebuilt when particles are sorted and constant in between.
//
// Owners are processed colour by colour. Two owners of one colour are at least two blocks apart along some axis, so the
// tiles that they scatter into (two nodes beyond the block on each side) never share a node. The order of owners within
// a colour does not matter and the order of colours is fixed, so the sums at a node do not depend on the number of
// threads.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/grid/grid_layout.hpp"

namespace mpm {

class BlockTable {
 public:
  explicit BlockTable(const GridLayout& layout) : layout_(&layout) {}

  /// `owner_keys`: ascending and unique. Takes time linear in the number of blocks in use.
  void rebuild(const std::vector<std::uint64_t>& owner_keys, int threads = 1);

  /// Takes more blocks into use, without owners: keys ascending and unique, none of them in use yet. Indices of blocks
  /// change; the generation does not.
  void admit(const std::vector<std::uint64_t>& keys);

  /// Gives every owner 3^dim blocks that it shares with no other (grid/node_choice.hpp). Keys may be there more than
  /// once, in any order; find() is not to be used.
  void rebuild_apart(const std::vector<std::uint64_t>& owner_keys);

  const GridLayout& layout() const { return *layout_; }
  int size() const { return static_cast<int>(keys_.size()); }  ///< blocks in use
  int owners() const { return static_cast<int>(owner_block_.size()); }
  /// Index of an owner among the blocks in use.
  int owner_block(int owner) const { return owner_block_[owner]; }
  int neighbour_count() const { return span_; }  ///< 3^dim
  /// Indices of the 3^dim neighbours of an owner, itself in the middle, the last axis fastest.
  const int* neighbours(int owner) const { return &neighbours_[static_cast<std::size_t>(owner) * span_]; }
  const std::array<int, 3>& block(int index) const { return coordinates_[index]; }
  std::uint64_t key(int index) const { return keys_[index]; }
  /// Index of the block with this key, or -1.
  int find(std::uint64_t key) const;
  int colours() const { return 1 << layout_->dim(); }
  const std::vector<int>& owners_of_colour(int colour) const { return colours_[colour]; }
  /// Number of rebuilds; a list of nodes found at another generation is out of date.
  std::uint64_t generation() const { return generation_; }

 private:
  void widen(std::uint64_t stride);
  /// Replaces blocks beyond the face of a periodic axis by the blocks at the other end that they coincide with.
  void wrap_blocks();
  void find_wrapped_neighbours(const std::vector<std::uint64_t>& owner_keys, std::size_t begin, std::size_t end);
  void find_neighbours(const std::vector<std::uint64_t>& owner_keys, std::size_t begin, std::size_t end);

  const GridLayout* layout_;
  int span_ = 0;
  std::array<std::uint64_t, 27> offset_{};  ///< difference of each neighbour's key
  std::vector<std::uint64_t> keys_, wider_;
  std::vector<std::array<int, 3>> coordinates_;
  std::vector<int> owner_block_, neighbours_;
  std::array<std::vector<int>, 8> colours_;
  std::uint64_t generation_ = 0;
};

}  // namespace mpm
