// Watch for blocks at rest, over a time in two halves. In each half no particle may exceed the speed, and the
// block's mean velocity over that half may not exceed a tenth of it; and the second half's may not be that of the first
// grown. So what swings fast may do so a little, as material in which waves run out does; what creeps has a mean
// velocity, what begins to slide one that grows, and a pendulum at the end of its way one in each half.
//
// Weak: motion slower than a tenth of the speed that does not grow is not seen, and lost while a block is asleep; so is
// motion that grows while it is below a hundredth.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/math/state_archive.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/ranks/halo.hpp"

namespace mpm {

/// State of one owner block.
struct RestWatchEntry {
  int field = 0;
  std::uint64_t key = 0;
  double begun = 0.0;               ///< time at which this half began [s]
  double fastest = 0.0;             ///< highest speed seen in this half [m/s]
  Vec3 mean = Vec3::Zero();         ///< sum of the mean velocities at each look [m/s]
  std::uint32_t looks = 0;          ///< in this half
  Vec3 half_before = Vec3::Zero();  ///< mean velocity in the half before [m/s]
  bool half_at_rest = false;        ///< the half before was at rest
  bool at_rest = false;             ///< for the time, and since
};

class RestWatch {
 public:
  static constexpr double kMean = 0.1;             ///< part of the speed that the mean velocity may reach
  static constexpr double kSeen = 0.01;            ///< part of the speed from which on its growth counts
  static constexpr std::uint32_t kLeastLooks = 4;  ///< in a half

  /// `speed` [m/s] and `time` [s], that of both halves.
  RestWatch(double speed, double time) : speed_(speed), half_(0.5 * time) {}

  /// To be called when particles were sorted. New blocks are watched from `now` [s] on.
  void follow(const Fields& fields, double now);
  /// Looks at all particles. Afterwards at_rest() tells of each owner.
  void look(const Fields& fields, const std::vector<ParticleSet>& sets, double now, int threads);
  /// True if an owner, by number through all fields, has been at rest for the time, and is since.
  bool at_rest(int owner) const { return entries_[owner].at_rest; }
  /// Takes all blocks to have been at rest for the time before.
  void trust_all();
  /// Watches an owner anew, as one that has not been at rest.
  void begin_again(int owner) { entries_[owner].half_at_rest = entries_[owner].at_rest = false; }
  /// To be called before particles are sorted: what is at rest has to be seen to be so again.
  void forget_rest();
  /// Over several ranks, after particles were sorted and before follow(): those whose blocks belong to others go there.
  /// Collective.
  void hand_over(Halo& halo);

  void serialise(StateArchive& archive);

 private:
  void put_in_order();
  void look_at(RestWatchEntry& entry, int owner, const std::vector<ParticleSet>& sets, double now);

  double speed_, half_;
  std::vector<RestWatchEntry> entries_, before_;  ///< entry of each owner, in their order: ascending by field and key
};

}  // namespace mpm
