// Particles go to the rank whose block they have come to, with all that they carry: before every sort, since between
// sorts they are within reach of the block that they were sorted into. Where ranks have come to have unequal numbers of
// particles the grid is divided anew first.
//
// Particles keep the order that they have in one process, which is that of the blocks they were sorted into last, and
// of the sorts before inside a block: so particles are computed in the same groups, and sorted again when one process
// would (step/mechanics.hpp, Mixed).
#pragma once

#include <unordered_map>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/ranks/communicator.hpp"
#include "mpm/ranks/territory.hpp"

namespace mpm {

/// Keys of the blocks that ParticleSet::begin is of, with the velocity field counted in.
std::vector<std::uint64_t> owner_keys(const Fields& fields);
/// The room that an array of so many particles gets where they come and go: more by a sixteenth to a quarter, in steps,
/// so that few are made anew before the grid is divided anew. A heap that gets arrays of ever other lengths keeps what
/// it cannot use, up to the size of all; room beyond the particles takes no memory before it is written.
std::size_t room_for_particles(std::size_t particles);

class HandOver {
 public:
  /// All must outlive this object.
  HandOver(Communicator& ranks, Territory& territory, const GridLayout& layout)
      : ranks_(ranks), territory_(territory), layout_(layout) {}

  /// At the start, wherever particles are: divides the grid, and hands over.
  void divide(std::vector<ParticleSet>& sets);
  /// Hands over what has come to others, and takes what has come here. A particle outside its set's bounds stays, for
  /// the sort to find. `owners`: owner_keys(), or empty before the first sort. Where particles come or go,
  /// ParticleSet::begin is no more.
  void hand_over(std::vector<ParticleSet>& sets, const std::vector<std::uint64_t>& owners = {});

  /// Particles of the fullest rank over the mean of all, at the last call of hand_over().
  double imbalance() const { return imbalance_; }
  std::uint64_t handed_over() const { return handed_over_; }  ///< particles of this rank, since the start
  std::uint64_t divisions() const { return divisions_; }      ///< how often the grid was divided anew
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
  /// Particles in the order that they have.
  struct Part {
    std::vector<int> particles;
    std::vector<Run> runs;
  };
  /// Particles of a set by where they go.
  struct Leaving {
    Part staying;
    std::vector<Part> to;  ///< [rank]
  };
  /// Room for one array of each type, kept: what is written anew takes it, and leaves its own for the next.
  struct Room {
    PaddedArray<double> doubles;
    PaddedArray<float> floats;
    PaddedArray<std::uint32_t> ids;
    PaddedArray<std::uint8_t> sides;
    PaddedArray<double>& of(const PaddedArray<double>&) { return doubles; }
    PaddedArray<float>& of(const PaddedArray<float>&) { return floats; }
    PaddedArray<std::uint32_t>& of(const PaddedArray<std::uint32_t>&) { return ids; }
    PaddedArray<std::uint8_t>& of(const PaddedArray<std::uint8_t>&) { return sides; }
  };
  struct Unpacking;
  static void pack(ParticleSet& set, const Part& leaving, Communicator::Bytes& bytes);
  /// Leaves those that stay, and puts those that come between them, by the blocks that they were sorted into.
  void replace(ParticleSet& set, const Part& staying, std::vector<Unpacking>& coming);
  /// Of each block of this rank, the number of its particles.
  Territory::Load load(const std::vector<ParticleSet>& sets) const;
  /// Whether a block and all around it are this rank's.
  bool is_inside(std::uint64_t key);
  /// Whether particles [begin, end) lie in that block or one around it.
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
  double after_cut_ = 1.0;     ///< what the last division left, as the call after it finds it
  bool just_divided_ = false;  ///< whether that is to be found
  std::uint64_t handed_over_ = 0, divisions_ = 0;
  Room room_;
};

}  // namespace mpm
