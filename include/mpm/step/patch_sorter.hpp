// Orders the particles that choose a velocity field at every node (grid/node_choice.hpp) by patch, and tells the sets
// where each patch and each group of the kernels begins. Done every step, since the choice is made every step;
// particles change places only where the patches ask for it, and only among those of a block.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/grid/node_choice.hpp"
#include "mpm/math/state_archive.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/sorter.hpp"

namespace mpm {

class PatchSorter {
 public:
  explicit PatchSorter(Grouping grouping) : grouping_(grouping) {}

  /// Notes where the blocks' particles begin, after a sort.
  void look_at(const std::vector<ParticleSet>& sets, const NodeChoice& choice);
  /// True if the sets have been sorted since look_at().
  bool outdated(const NodeChoice& choice) const { return generation_ != choice.sorted(); }
  /// The particles of a set in a block of NodeChoice::blocks(): from the first to one before the next block's first.
  std::uint32_t begin(std::size_t set, std::size_t block) const { return begin_[set][block]; }

  /// `patch`: of each particle of a set from begin(set, 0) on; patches of a block follow each other. Sorts within the
  /// blocks.
  void sort(std::size_t number, ParticleSet& set, const NodeChoice& choice, const std::vector<int>& patch);
  /// Writes or reads where blocks begin, for checkpoints.
  void serialise(StateArchive& archive, NodeChoice& choice);

 private:
  void permute(ParticleSet& set, std::uint32_t first, std::size_t count);

  Grouping grouping_;
  std::uint64_t generation_ = 0;
  std::vector<std::vector<std::uint32_t>> begin_;  ///< [set][block], and the end
  std::vector<std::uint32_t> key_, order_, next_;
  std::vector<double> doubles_;
  std::vector<float> floats_;
  std::vector<std::uint32_t> ids_;
  std::vector<std::uint8_t> sides_;
};

}  // namespace mpm
