// Sorts every set of particles by grid block, and inside a block by nearest node, and tells the grid which blocks are
// in use. Done when a particle has left the reach of its block, not every step: the tile of a block reaches two nodes
// beyond it, one more than a sorted particle needs.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mpm/grid/nodal_fields.hpp"
#include "mpm/particles/particle_set.hpp"

namespace mpm {

/// A particle, by its set and its place in it.
struct ParticleRef {
  int set = 0;
  int index = 0;
};

/// How many particles a kernel takes at once, and what they must have in common: all are in one block, and their
/// nearest nodes are one column along the last grid axis, or one node.
struct Grouping {
  enum class By { column, node };
  int lanes = 1;  ///< at most so many particles a group
  By by = By::node;
};

class Sorter {
 public:
  explicit Sorter(int threads, Grouping grouping = {}) : threads_(threads), grouping_(grouping) {}

  /// Sorts, and rebuilds the blocks of `grid`. Returns a particle that is not where its set allows, or not finite, if
  /// there is one (the first by set and place); then nothing has been changed.
  std::optional<ParticleRef> sort(std::vector<ParticleSet>& sets, Grid& grid);

 private:
  struct Entry {
    std::uint64_t key;
    std::uint32_t index;
  };
  /// Least significant digit first, stable.
  void radix_sort(std::vector<Entry>& entries);
  void permute(ParticleSet& set, const std::vector<Entry>& entries);
  /// Fills in the groups of a sorted set whose `begin` is known.
  void find_groups(ParticleSet& set, const std::vector<Entry>& entries) const;

  int threads_;
  Grouping grouping_;
  std::vector<std::vector<Entry>> entries_;
  std::vector<Entry> other_;
  std::vector<std::uint64_t> owner_keys_;
  PaddedArray<double> scratch_;
  PaddedArray<float> float_scratch_;
  PaddedArray<std::uint32_t> id_scratch_;
};

}  // namespace mpm
