// Particles that would leave the grid: put back just inside it, without the part of their velocity that led out, and
// counted. A few that spray off do not end a long run then; many are a run that went wrong, or a grid that is too
// small.
//
// Over several ranks each puts back its own, and then hears of those of the others: count, sums and who has left are
// the whole run's on each of them, since a particle that comes back to the edge may do so on another rank.
//
// Weak: what is put back has been moved by up to the way that it was outside, without any work being booked.
// Source: NairnMPM, MPMHeader, LeaveLimit.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/grid/grid_layout.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/module.hpp"

namespace mpm {

class Leaving final : public Module {
 public:
  /// `limit`: how many particles may leave; each counts once, however often it comes back to the edge.
  /// `sets`, `layout` and `ranks`, which is null on one process, outlive this.
  Leaving(std::uint64_t limit, std::vector<ParticleSet>& sets, const GridLayout& layout, Communicator* ranks)
      : limit_(limit), sets_(sets), layout_(layout), ranks_(ranks) {
    account_.name = "returned";
  }

  std::string name() const override { return "leaving"; }
  bool same_on_all_ranks() const override { return true; }
  void accounts(std::vector<ImpulseAccount>& list) const override { list.push_back(account_); }
  /// "leaving", dissipated: the kinetic energy of the motion that led out.
  void energies(EnergyReport& report) const override { report.add("leaving", NamedEnergy::Kind::dissipated, taken_); }
  /// "returned": how many particles have left.
  void numbers(std::vector<NamedNumber>& list) const override {
    list.push_back({"returned", "1", static_cast<double>(count_)});
  }

  /// Puts back every particle that is beyond the place where its set may be. False when there is one that cannot be,
  /// since it is not finite or the limit has been passed; then the particles that come after it are as they were.
  bool put_back() override;
  /// Books what a device (step/device.hpp) has done in this place: particles that it has put back, by id, momentum [N
  /// s] and energy [J]. False when more have left than may.
  bool count(const std::vector<std::uint32_t>& ids, const Vec3& given, double taken);
  /// The reason then.
  OutsideReason too_many() const;
  std::optional<OutsideReason> why_outside(const GridLayout&, const ParticleSet&, int particle) const override;
  void serialise(StateArchive& archive) override {
    archive.value("count", count_);
    archive.list("left", left_);
    account_.serialise(archive);
    archive.value("taken", taken_);
  }

 private:
  /// Result of one call of put_back() did.
  struct Returned {
    bool all = true;  ///< true if every particle could be put back
    Vec3 given = Vec3::Zero();
    double taken = 0.0;
    std::vector<std::uint32_t> first;  ///< ids of those that have not left before
  };
  bool has_left(std::uint32_t id) const { return id < left_.size() && left_[id] != 0; }
  /// Puts back this rank's particles.
  Returned put_back_own();
  /// Makes what each rank did what all of them did.
  void share(Returned& returned);

  std::uint64_t limit_;
  std::vector<ParticleSet>& sets_;
  const GridLayout& layout_;
  Communicator* ranks_;
  std::uint64_t count_ = 0;
  std::vector<std::uint8_t> left_;  ///< by id
  ImpulseAccount account_;
  double taken_ = 0.0;  ///< [J]
};

}  // namespace mpm
