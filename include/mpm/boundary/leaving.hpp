// Particles that would leave the grid: put back just inside it, without the part of their velocity that led out, and
// counted. A few that spray off do not end a long run then; many are a run that went wrong, or a grid that is too
// small.
//
// Weak: what is put back has been moved by up to the way that it was outside, without any work being booked.
// Source: NairnMPM, MPMHeader, LeaveLimit.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/grid/grid_layout.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

class Leaving final {
 public:
  /// `limit`: how many particles may leave; each counts once, however often it comes back to the edge.
  explicit Leaving(std::uint64_t limit) : limit_(limit) { account_.name = "returned"; }

  /// Puts back every particle that is beyond the place where its set may be. False when there is one that cannot be,
  /// since it is not finite or the limit has been passed; then the particles that come after it are as they were.
  bool put_back(std::vector<ParticleSet>& sets, const GridLayout& layout);
  std::uint64_t limit() const { return limit_; }
  std::uint64_t count() const { return count_; }  ///< of the particles that have left
  const ImpulseAccount& account() const { return account_; }
  /// For checkpoints.
  void keep(StateArchive& archive) {
    archive.keep("count", count_);
    archive.list("left", left_);
    account_.keep(archive);
  }

 private:
  std::uint64_t limit_;
  std::uint64_t count_ = 0;
  std::vector<std::uint8_t> left_;  ///< by id
  ImpulseAccount account_;
};

}  // namespace mpm
