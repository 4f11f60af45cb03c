// Sleep: blocks of material at rest are not stepped, and wake when a tool, a wave or other material arrives or their
// support changes, so that a step costs what moves and not what is there.
//
// A block falls asleep when it has been at rest for a time (rest_watch.hpp), away from tools and from other bodies'
// velocity fields. Its motion is taken, its stress stays. The nodes that it shares with what is awake are held at rest
// (sleep_border.hpp): the impulse of holding them, the weight of what is asleep, which nothing in a step carries any
// more, and the momentum that was taken make the account "sleep" of the audit, and the kinetic energies that were taken
// the energy "sleep". A block wakes when a wave or other material arrives at its border, when the force there has lost
// a part of its balance (a tenth, unless the scene says another), when a tool comes as near as four cells, or when
// another body's material comes as near as a block; and when loads, conditions, what is transported or a crack ask for
// it (step/rest_partner.hpp), each of which keeps blocks awake, too. A load that stays is part of the balance, as
// gravity is.
//
// An implicit step holds the nodes at the border itself, as walls hold theirs, and leaves them the velocity that they
// would have had, from which this takes the same impulse. It costs as much as many explicit steps, so that looks and
// sorts need not wait.
//
// Damping eases the way to rest: nodes slower than four times the speed lose a part of the force without balance that
// drives them on, and gain it where that force slows them. It is off unless the scene asks for it.
//
// Weak: a wave too weak to wake a block is thrown back at its border as by a wall. Friction at the domain's faces
// under a block that is asleep is not found, so their force is that of what is awake. What creeps slower than a tenth
// of the speed is frozen.
// Source of the damping: P. A. Cundall (1987), Distinct element models of rock and soil structure, in Analytical and
// Computational Methods in Engineering Rock Mechanics, Allen & Unwin, 129-163.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mpm/loop/chunk_sums.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/sleep/rest_watch.hpp"
#include "mpm/sleep/sleep_across_ranks.hpp"
#include "mpm/sleep/sleep_border.hpp"
#include "mpm/sleep/sleep_definition.hpp"
#include "mpm/sleep/sleeping_blocks.hpp"
#include "mpm/step/rest_partner.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

/// Parts that a run hands to Sleep; the references outlive it.
struct SleepParts {
  Fields& fields;
  std::vector<ParticleSet>& sets;
  const std::vector<RigidBody>& bodies;
  std::unique_ptr<BlockProbe> probe;
  Vec3 gravity = Vec3::Zero();  ///< [m/s^2]
  int threads = 1;
  bool implicit = false;  ///< true if steps are implicit
  bool averaged = false;  ///< true if volume changes are averaged over the grid
  Halo* halo = nullptr;   ///< null for one process
  /// Those who act on material at rest; they outlive it.
  std::vector<RestPartner*> partners = {};
};

/// Times that the work of sleep waits, so that it costs a small part of steps.
struct SleepPace {
  std::uint32_t between_looks;  ///< steps
  std::uint32_t looks_to_wait;  ///< for a sort that others ask for, before one is asked for to fall asleep
  std::uint32_t steps_to_wait;  ///< for others at the border of unrest, before blocks are woken
};

/// Distance from a tool within which nothing sleeps [cells].
inline constexpr double kNearTool = 4.0;

class Sleep final : public Stage {
 public:
  Sleep(const SleepDefinition& definition, SleepParts parts);

  std::string name() const override { return "sleep"; }
  Ranks ranks(Hook hook) const override { return {hook == Hook::momentum_updated ? Rank::at_rest : Rank::asleep}; }
  void momentum_gathered(StepContext& context) override;
  void before_strain(StepContext& context) override;
  void forces_gathered(StepContext& context) override;
  void momentum_updated(StepContext& context) override;
  void velocity_found(StepContext& context) override;
  void increment_found(StepContext& context) override;
  void grid_advanced(StepContext& context) override;

  /// Sorts cost, so those who are to wake wait some steps for others, unless it is urgent, and those who may fall
  /// asleep wait for a sort that is asked for by others, though not for long.
  bool needs_sort() const override;
  void body_put(const RigidBody& body) override;
  void before_sort() override;
  /// Puts nothing back, but over several ranks others may have come before the sort that failed.
  bool put_back() override {
    asleep_.follow_moves();
    return false;
  }
  void share_memory(Communicator&) override;

  // For what makes ground and puts it away between two steps (sleep_between_steps.cpp).

  using Which = std::function<bool(std::uint64_t key)>;  ///< true for the keys of some blocks
  /// Blocks that stay asleep, whatever comes, as long as they are named.
  void keep_asleep(Which stays) { stays_ = std::move(stays); }
  /// Puts blocks to sleep that are awake. Particles have to be sorted, and again after it.
  void lay_asleep(const Which& which);
  /// The particles of a block asleep are there no more, nor is its weight.
  void take_away(const BlockName& name);
  /// Call when particles have come to sets or gone from them (particles/append.hpp).
  void follow_moves() { asleep_.follow_moves(); }
  const SleepingBlocks& asleep() const { return asleep_; }

  // For a device that takes the steps (step/device.hpp).

  /// True if the velocities of particles are looked at in the next step.
  bool looks_next() const { return !begun_ || steps_ + 1 >= pace_.between_looks; }
  /// True if all nodes are looked at in the step, and not only those that are held.
  bool needs_all_nodes() const { return definition_.damping > 0.0 || (!begun_ && definition_.from_start); }
  /// True if some may fall asleep, and partners are to find the forces on them.
  bool needs_forces() const;
  void find_forces(const StepContext& context) const;
  /// True if particles may fall asleep or wake when they are sorted.
  bool has_work_for_sort() const { return !sleepers_.empty() || !to_wake_.empty(); }

  void accounts(std::vector<ImpulseAccount>& list) const override { list.push_back(account_); }
  void energies(EnergyReport& report) const override;
  void numbers(std::vector<NamedNumber>& list) const override;
  void limit_step(const PeriodAhead& period, StepLimit& limit) const override;
  std::string limit_text(const StepLimit& limit) const override;
  void serialise(StateArchive& archive) override;
  void hashed(std::vector<double>& numbers) const override;

 private:
  struct Taken {
    Vec3 impulse = Vec3::Zero();
    double energy = 0.0;
    Taken& operator+=(const Taken& other) {
      impulse += other.impulse;
      energy += other.energy;
      return *this;
    }
  };

  /// True if particles have been sorted since the last step.
  bool follow_sort(const StepContext& context);
  /// After a checkpoint has been read: the numbers of their owners.
  void find_owners_of_sleepers();
  void look(const StepContext& context);
  /// Puts `sleepers_` to sleep, whose particles are sorted.
  void fall_asleep();
  /// Takes out of `to_wake_` what stays asleep.
  void leave_what_stays();
  /// On any rank.
  bool none_asleep() const;
  /// True if a tool is so near to a block that it has to be awake, in steps of `dt` [s].
  bool tool_near(const std::array<int, 3>& block, double dt) const;
  /// Steps until the next look has been done, and what it found has woken.
  double ahead_of_looks() const { return 2.0 * pace_.between_looks; }
  /// True if a partner has a block awake that is at rest otherwise.
  bool is_kept_awake(const RestingBlock& block, const RestTimes& times) const;
  RestingBlock awake_block(int field, int owner) const;
  static RestingBlock asleep_block(const SleepingBlock& block, const GridLayout& layout);
  /// Adds blocks asleep that partners wake. `after_sort`: only those that move with sorts.
  void ask_partners(const StepContext& context, bool after_sort);
  /// Wakes what is asleep, or takes it away, and tells partners.
  void tell_of_waking(const BlockName& name) const;
  /// True if material of another velocity field is near to a block of one.
  bool other_near(int field, std::uint64_t key) const;
  void find_unrest(StepContext& context);
  void find_unrest(const Grid& grid, SleepBorder& border, double dt);
  void strike_what_sets_off(StepContext& context);
  Taken hold(Grid& grid, const SleepBorder& border, double dt);
  Taken damp(Grid& grid, double dt);

  SleepDefinition definition_;
  SleepParts parts_;
  SleepPace pace_;
  const GridLayout& layout_;
  SleepingBlocks asleep_;
  RestWatch watch_;
  std::unique_ptr<SleepAcrossRanks> across_;       ///< null for one process
  std::vector<SleepBorder> borders_;               ///< border of each field
  std::uint64_t generation_ = 0;                   ///< generation of the blocks that borders_ and watch_ were made for
  std::uint32_t steps_ = 0;                        ///< since the last look
  std::uint32_t looks_waited_ = 0;                 ///< by those who may fall asleep
  std::uint32_t steps_waited_ = 0;                 ///< by those who are to wake
  bool at_once_ = false;                           ///< one of them cannot wait
  Which stays_;                                    ///< may be empty
  double now_ = 0.0;                               ///< end of the last step [s]
  bool begun_ = false;                             ///< the first step is done
  bool just_read_ = false;                         ///< a checkpoint has been read, and no step has followed
  std::vector<SleepingBlocks::Sleeper> sleepers_;  ///< those who may fall asleep, without forces yet
  std::vector<BlockName> to_wake_;                 ///< ascending, each once
  std::vector<SleepBorder::Unrest> unrest_;        ///< unrest of the nodes of a border
  ChunkSums<Taken> sums_;
  ImpulseAccount account_;
  Vec3 given_ = Vec3::Zero();  ///< in this step [N s]
  double energy_ = 0.0;        ///< taken since the start by falling asleep and holding [J]
  double damped_ = 0.0;        ///< the same by damping [J]
};

}  // namespace mpm
