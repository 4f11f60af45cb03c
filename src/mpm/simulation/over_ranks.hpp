// A run over several ranks (ranks/communicator.hpp): which blocks are this rank's, what crosses its border, and sums
// over all. A run on one process has none of this. Private to this folder.
//
// What is the same on all ranks: time, steps, rigid bodies and contact with them, the sums of modules that say so
// (Module::same_on_all_ranks). What each rank has of its own: particles, nodes around them, sums of other modules,
// which are parts that are added up when they are asked for.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mpm/ranks/halo.hpp"
#include "mpm/ranks/hand_over.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/step/energy.hpp"
#include "mpm/step/mechanics.hpp"
#include "mpm/step/modules.hpp"
#include "mpm/step/sorter.hpp"
#include "mpm/step/step_limit.hpp"

namespace mpm {

/// Marks of what comes after a step.
struct StepFlags {
  bool failed;  ///< a particle has
  bool sorts;   ///< particles have to be sorted
  bool stops;   ///< the run is asked to stop
  bool meets;   ///< ranks have to meet, since a tool has come near to blocks that not all of them have
};

class OverRanks {
 public:
  /// All outlive this object.
  OverRanks(Communicator& ranks, const GridLayout& layout, const std::vector<RigidBody>& bodies);

  Communicator& ranks() { return ranks_; }
  Halo& halo() { return halo_; }
  const Halo& halo() const { return halo_; }
  const HandOver& hand_over() const { return hand_over_; }

  void divide(std::vector<ParticleSet>& sets) { hand_over_.divide(sets); }
  /// `fields`: as particles have been sorted into them last.
  void hand_over(std::vector<ParticleSet>& sets, const Fields& fields);
  /// The order of particles after it, for the sort.
  const std::vector<ParticleOrder>& orders() const { return hand_over_.orders(); }
  /// After a sort that has failed at a particle: puts particles in that order, and `at` to where it is then.
  void settle(std::vector<ParticleSet>& sets, ParticleRef& at);
  /// After particles have been sorted.
  void meet(Fields& fields);
  /// After a step: what is true on any rank. Particles are sorted, too, where the mechanics of all ranks together say
  /// so. Not because of tools, for which one process does not sort.
  StepFlags shared(const StepFlags& own, const Mechanics& mechanics);
  /// Says how many ranks have nothing to do, if any; after particles have been sorted.
  void warn_of_idle(const std::vector<ParticleSet>& sets, std::vector<std::string>& warnings);

  /// The smallest of all ranks' limits, of the first rank that has it. `modules` number the module that sets it.
  void share(StepLimit& limit, const Modules& modules, const Module* mechanics);
  void add_up(EnergyReport& report);
  void add_up(std::vector<ImpulseAccount>& accounts);
  void add_up(std::vector<NamedNumber>& numbers);
  void add_up(Vec3& vector);
  /// One hash of all ranks' hashes, in their order.
  std::uint64_t hash_of_all(std::uint64_t own);

  /// For checkpoints that as many ranks read.
  void serialise(StateArchive& archive);
  /// After the blocks have been read from such a checkpoint.
  void meet_as_read(Fields& fields);

 private:
  bool tools_have_moved() const;
  /// True if a block is near a tool as it was when ranks met, so that all ranks have to have it.
  Halo::Everywhere near_tool() const;

  Communicator& ranks_;
  const GridLayout& layout_;
  const std::vector<RigidBody>& bodies_;
  Territory territory_;
  HandOver hand_over_;
  Halo halo_;
  std::vector<Pose> met_at_;  ///< poses of the bodies when ranks last met
};

}  // namespace mpm
