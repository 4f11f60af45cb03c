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

class Sorter {
 public:
  explicit Sorter(int threads) : threads_(threads) {}

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

  int threads_;
  std::vector<std::vector<Entry>> entries_;
  std::vector<Entry> other_;
  std::vector<std::uint64_t> owner_keys_;
  std::vector<double> scratch_;
  std::vector<std::uint32_t> id_scratch_;
};

}  // namespace mpm
