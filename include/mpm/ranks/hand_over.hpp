// Particles go to the rank whose block they have come to, with all that they carry: before every sort, since between
// sorts they are within reach of the block that they were sorted into. Where ranks have come to have unequal numbers of
// particles the grid is divided anew first.
//
// Particles keep the order that they have in one process, which is that of the blocks they were sorted into last, and
// of the sorts before inside a block: so particles are computed in the same groups, and sorted again when one process
// would (step/mechanics.hpp, Mixed). Those that come take the places of those that go; the sort that follows puts them
// in order. What is asleep stays on its rank.
#pragma once

#include <unordered_map>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/particles/particle_order.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/ranks/communicator.hpp"
#include "mpm/ranks/territory.hpp"

namespace mpm {

/// Keys of the blocks that ParticleSet::begin is of, with the velocity field counted in.
std::vector<std::uint64_t> owner_keys(const Fields& fields);

class HandOver {
 public:
  /// All must outlive this object.
  HandOver(Communicator& ranks, Territory& territory, const GridLayout& layout)
      : ranks_(ranks), territory_(territory), layout_(layout) {}

  /// At the start, wherever particles are: divides the grid, and hands over.
  void divide(std::vector<ParticleSet>& sets);
  /// Hands over what has come to others, and takes what has come here. A particle outside its set's bounds stays, for
  /// the sort to find. `owners`: owner_keys(), or empty before the first sort. Afterwards each set has the particles of
  /// its order, in that order: for the sort, or else for settle().
  void hand_over(std::vector<ParticleSet>& sets, const std::vector<std::uint64_t>& owners = {});
  const std::vector<ParticleOrder>& orders() const { return orders_; }
  /// Puts particles in their order where no sort has, and clears ParticleSet::begin.
  void settle(std::vector<ParticleSet>& sets);

  /// Particles of the fullest rank over the mean of all, at the last call of hand_over().
  double imbalance() const { return imbalance_; }
  std::uint64_t handed_over() const { return handed_over_; }  ///< particles of this rank, since the start
  std::uint64_t divisions() const { return divisions_; }      ///< number of times that the grid was divided anew
  /// For checkpoints.
  void serialise(StateArchive& archive) {
    archive.value("after_cut", after_cut_);
    archive.value("just_divided", just_divided_);
    if (archive.reading()) inside_.clear();
  }

 private:
  /// Particles of a set that were sorted into one block, one after another.
  struct Run {
    std::uint64_t key, count;
  };
  /// Particles that go to one rank, by their places, in their order.
  struct Part {
    std::vector<std::uint32_t> places;
    std::vector<Run> runs;
  };
  /// Places one after another of particles that were sorted into one block.
  struct Piece {
    std::uint64_t key;
    ParticleOrder::Span span;
  };
  /// Particles of a set by where they go.
  struct Leaving {
    std::vector<Piece> staying;
    std::vector<std::uint32_t> left;  ///< places of all that go, ascending
    std::vector<Part> to;             ///< [rank]
  };
  struct Unpacking;
  static void pack(ParticleSet& set, const Part& part, Communicator::Bytes& bytes);
  /// Puts those that come where others have left, and into the order by the blocks that they were sorted into.
  static void take_in(ParticleSet& set, Leaving& leaving, std::vector<Unpacking>& coming, ParticleOrder& order);
  /// Number of particles of each block of this rank.
  Territory::Load load(const std::vector<ParticleSet>& sets) const;
  /// True if a block and all around it are this rank's.
  bool is_inside(std::uint64_t key);
  /// True if particles [begin, end) lie in that block or one around it.
  bool are_around(const ParticleSet& set, int begin, int end, std::uint64_t key) const;
  void find_leaving(const ParticleSet& set, const std::vector<std::uint64_t>& owners, Leaving& leaving);
  void cut(const std::vector<ParticleSet>& sets);
  void divide_anew_if_due(const std::vector<ParticleSet>& sets);
  void send(std::vector<ParticleSet>& sets, const std::vector<std::uint64_t>& owners);

  Communicator& ranks_;
  Territory& territory_;
  const GridLayout& layout_;
  std::unordered_map<std::uint64_t, bool> inside_;  ///< is_inside() of blocks asked about since the last cut
  double imbalance_ = 1.0;
  double after_cut_ = 1.0;     ///< imbalance that the last division left, as the call after it finds it
  bool just_divided_ = false;  ///< true if that is to be found
  std::uint64_t handed_over_ = 0, divisions_ = 0;
  std::vector<ParticleOrder> orders_;  ///< order of each set
};

}  // namespace mpm
