// Sorts the particles of every set that are awake by velocity field, in a field by grid block, and inside a block by
// nearest node, and tells each field which blocks are in use. Done when a particle has left the reach of its block or
// too many have left their group, not every step: the tile of a block reaches two nodes beyond it, one more than a
// sorted particle needs.
//
// A stable sort has one result, so it does not depend on the number of threads. It counts in two levels: particles by
// block, a contiguous part of them a thread and the parts in order, then the particles of a block by node, in cache. In
// a run they are nearly in order already, so the first level reads and writes almost in sequence, where a sort by the
// least significant digit would scatter them over all of memory and bring them back.
// Scratch is kept between sorts, 25 bytes a particle (29 in single precision) and little more.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/grid/node_choice.hpp"
#include "mpm/particles/permute.hpp"

namespace mpm {

/// A particle, by its set and its index in that set.
struct ParticleRef {
  int set = 0;
  int index = 0;
};

/// Number of particles that a kernel takes at once, and what they must have in common: all are in one block, and their
/// nearest nodes are one column along the last grid axis, or one node.
struct Grouping {
  enum class By { column, node };
  int lanes = 1;  ///< largest number of particles in a group
  By by = By::node;
};

class Sorter {
 public:
  /// `choice`: of particles that choose a field at every node, which are sorted into a field of their own after the
  /// others; null where there are none. It outlives the sorter.
  explicit Sorter(int threads, Grouping grouping = {}, NodeChoice* choice = nullptr);

  /// Sorts, and rebuilds the blocks of every field. Owners are numbered through all fields. Returns the first
  /// particle (by set and index) that is outside the range of its set or not finite, if there is one; then nothing has
  /// been changed. `orders`: of each set, which particles it has and in what order; null where they are as in memory.
  std::optional<ParticleRef> sort(std::vector<ParticleSet>& sets, Fields& fields,
                                  const std::vector<ParticleOrder>* orders = nullptr);

 private:
  class RecentBlocks;
  /// Memory that is kept for a set between sorts, one value for each particle.
  struct Scratch {
    /// Key of the block, counted on from field to field, then its rank among owners; times nodes a block, plus node.
    PaddedArray<std::uint64_t> code;
    PaddedArray<std::uint32_t> order;  ///< place before the sort
    PaddedArray<std::uint8_t> node;    ///< in its block, in sorted order
    PermuteScratch values;
    ParticleOrder in_memory;  ///< order if none is given
    const ParticleOrder* before = nullptr;
    std::size_t room = 0;  ///< that arrays get which are made anew [particles]
  };
  /// Memory of a thread.
  struct Part {
    std::vector<std::uint64_t> blocks;  ///< that it has found
    std::vector<std::uint32_t> next;    ///< place of the next particle of each owner
    std::vector<std::uint32_t> order;
  };

  /// Writes the codes. Returns the place of the first particle outside the range of its set, or one past all.
  template <int Dim>
  std::size_t find_blocks(const ParticleSet& set, const GridLayout& layout, Scratch& scratch);
  void collect_owners(const GridLayout& layout);
  void sort_by_block(ParticleSet& set, Scratch& scratch);
  void sort_by_node(ParticleSet& set, Scratch& scratch);
  void fill_groups(ParticleSet& set, const Scratch& scratch) const;
  void rebuild(const std::vector<ParticleSet>& sets, Fields& fields);
  /// First particle of a thread's part of `count`.
  std::size_t part_begin(std::size_t count, int part) const { return count * part / threads_; }

  int threads_;
  Grouping grouping_;
  NodeChoice* choice_;
  unsigned node_bits_ = 0;  ///< bits of a code
  std::vector<Scratch> scratch_;
  std::vector<Part> parts_;
  std::vector<std::uint64_t> owner_keys_;       ///< keys of all fields, counted on from field to field
  std::vector<std::uint64_t> field_keys_;       ///< keys of one field
  std::vector<std::uint32_t> field_particles_;  ///< particles of each of its owners
};

}  // namespace mpm
