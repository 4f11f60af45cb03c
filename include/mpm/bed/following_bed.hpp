// Ground that is there around the bodies that it follows, and nowhere else. It comes and goes by columns of blocks
// (bed_columns.hpp), at sync points:
//
//   made       where a body comes nearer than the distance, and one column beyond. Where it was never before it is what
//              the scene has there, else what was put away (kept_ground.hpp); in both cases at rest under its weight's
//              stress, and asleep.
//   put away   where all bodies are farther by two columns more, and all of it is asleep, and so is all beside it.
//   stopped    where all are farther than twice the distance and it is not asleep, so that it can be put away.
//
// The outermost columns, beside those without ground, stay asleep whatever comes: their nodes are held, and the ground
// between them stands as it would on ground that goes on (sleep/sleep.hpp). Particles that fly or roll over them into a
// column without ground are put away at the next sync point, as mass in that column.
//
// All that is made and put away is counted: its mass, its momentum (the account "ground") and its energy (the work
// "ground").
//
// Weak: waves that reach the outermost columns are thrown back as by a wall. What still slides at twice the distance
// stops there.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mpm/bed/bed_columns.hpp"
#include "mpm/bed/bed_definition.hpp"
#include "mpm/bed/kept_ground.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/sleep/sleep.hpp"
#include "mpm/step/module.hpp"

namespace mpm {

/// All outlive the module.
struct BedParts {
  std::vector<ParticleSet>& sets;  ///< one, of the ground
  const Fields& fields;
  const std::vector<RigidBody>& bodies;
  Sleep& sleep;
};

class FollowingBed final : public Module {
 public:
  FollowingBed(const BedDefinition& definition, BedParts parts);

  std::string name() const override { return "ground"; }
  void accounts(std::vector<ImpulseAccount>& list) const override { list.push_back(account_); }
  void energies(EnergyReport& report) const override { report.add("ground", NamedEnergy::Kind::work, energy_); }
  void numbers(std::vector<NamedNumber>& list) const override;
  void serialise(StateArchive& archive) override;
  void hashed(std::vector<double>& numbers) const override;

  // Calls of a run, at the start and at sync points, in this order (simulation/follow_bed.cpp).

  /// Fault of the places of bodies, in a sentence; nothing where each is on ground that can move.
  std::optional<std::string> fault() const;
  /// Finds what is to be put away and made. True if there is anything. Particles are sorted.
  bool look();
  /// Puts to sleep what look() has found too far away to move. True if there is any; then particles have to be sorted
  /// after it, and looked at anew.
  bool stop_far();
  /// Puts away what look() has found. Particles have to be sorted after it.
  void put_away();
  /// Fills `ground` with the particles of the columns that look() has found. Nothing is there of them yet.
  void fill(GroundParticles& ground);
  /// Adds particles of that ground, awake. They get ids of their own. Particles have to be sorted after it.
  /// @throws ModuleError when all ids are used up
  void add(ParticleSet& made);
  /// Puts to sleep what has been made, at the start the outermost columns. Particles have to be sorted, and again after
  /// it.
  void lay_asleep();
  /// Counts energy [J] that came with what was made, less what went with what was put away.
  void count_energy(double energy) { energy_ += energy; }

 private:
  void find_rim();
  std::vector<Vec3> places() const;
  /// Columns with material that is awake.
  BedColumns::Flags awake() const;
  void put_strays_away();
  /// Mass of a whole particle that is made of what was kept [kg].
  double whole_mass() const;
  void keep(int column, const ParticleSet& set, std::uint32_t particle);
  Vec3 place_of(const ParticleSet& set, std::uint32_t particle) const;

  BedDefinition definition_;
  BedParts parts_;
  const GridLayout& layout_;
  BedColumns columns_;
  KeptGround kept_;
  std::vector<const RigidBody*> followed_;
  BedColumns::Flags present_;  ///< columns that have ground
  BedColumns::Flags virgin_;   ///< columns that never had any
  BedColumns::Flags rim_;      ///< outermost of those that have ground
  BedColumns::Flags laid_;     ///< columns that are to be put to sleep
  std::vector<int> to_make_, to_put_away_, to_stop_;
  std::vector<std::size_t> stacked_;  ///< numbers of the particles that fill() has made of what was kept
  bool strays_ = false;
  std::uint64_t next_id_;
  double made_ = 0.0, put_away_ = 0.0;  ///< mass since the start [kg]
  ImpulseAccount account_;
  double energy_ = 0.0;  ///< [J]
};

}  // namespace mpm
