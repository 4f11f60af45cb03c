// The wall time that a sync period may take, kept by ending sweeps (scene key time.budget). Sweeps are what an implicit
// step can do less of: momentum is exact after any number of them, and the force on tools alone is less settled.
//
// A step ends its sweeps when one more would not leave the time that the rest of the sync period takes: what follows
// the sweeps of this step, and as much for each step to come. Both are foreseen by what they took before, where more
// is believed at once and less by and by. A step makes kLeastSweeps in any case, so that a budget bounds a period from
// there on alone; least() says how long that takes.
//
// The error that this leaves in the force is estimated by how much it changed in the last half of the sweeps. This
// change tells less than the error where sweeps are few, since a step begins with the impulses of the step before,
// which were cut, too: below 0.9 sweeps a millisecond the error was found to be the more times the change
// (doc/loop.md).
//
// Steps that were cut so, and their sweeps, are all that a run owes to the clock: a run that is given them by repeat()
// makes the same bits, and asks no clock.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "mpm/math/state_archive.hpp"
#include "mpm/step/module.hpp"

namespace mpm {

inline constexpr int kLeastSweeps = 10;           ///< sweeps of a step whose number of sweeps is not prescribed
inline constexpr double kForceErrorBound = 0.05;  ///< error of the force on tools, over the force: more is told of

/// A step whose sweeps the budget ended.
struct CutStep {
  std::uint64_t step = 0;  ///< since the start of the run, from 1
  std::int32_t sweeps = 0;
};

/// Result of the sweeps of a step.
struct SweepsMade {
  int sweeps = 0;
  double force = 0.0;   ///< pressed on all tools together, over the step [N s]
  double change = 0.0;  ///< change of that in the last half of the sweeps [N s]
};

class SweepBudget {
 public:
  using Clock = std::chrono::steady_clock;

  /// Wall time of a sync period [s].
  explicit SweepBudget(double seconds);

  /// A sync period begins: after so many steps of the run, to end at `end` [s] of simulated time. `late`: how much of
  /// its wall time has gone already.
  void begin_period(std::uint64_t steps, double end, Clock::duration late);
  void end_period();

  /// The sweeps of a step begin; it begins at `start` and lasts `dt` [s] of simulated time.
  void begin_sweeps(double start, double dt);
  /// True if they end after so many, which would go on else. Asks the clock once, from kLeastSweeps on.
  bool ends_after(int sweeps);
  void end_sweeps(const SweepsMade& made);

  /// Makes the run cut these steps, and no others, whatever time they take. In their order.
  void repeat(std::vector<CutStep> steps) { recorded_ = std::move(steps); }
  bool repeats() const { return recorded_.has_value(); }

  double seconds() const { return seconds_; }
  /// Wall time that a sync period takes with kLeastSweeps in each step [s], in the mean; nothing before it is known.
  std::optional<double> least() const;
  /// Steps cut in the last sync period.
  const std::vector<CutStep>& cut() const { return cut_; }
  /// Estimated error of the force on tools in the last few steps, over the force, or a tenth of the largest that was
  /// met where that is more: of a tool that hardly touches nothing is known. 1 at most.
  double error() const;
  /// The largest such error at a step that was cut in the last sync period; 0 where none was.
  double cut_error() const { return cut_error_; }

  void numbers(std::vector<NamedNumber>& list) const;
  void serialise(StateArchive& archive);

 private:
  bool recorded_ends_after(int sweeps) const;

  const double seconds_;
  std::uint64_t step_ = 0;  ///< under way
  double end_ = 0.0;        ///< end of the sync period, simulated [s]
  Clock::time_point begun_, deadline_;
  bool swept_ = false;                     ///< in this sync period
  Clock::time_point sweeps_at_, done_at_;  ///< start of a step's sweeps, end of the last ones'
  double for_sweeps_ = 0.0;                ///< time of this step's sweeps [s]
  bool ended_here_ = false;                ///< the sweeps of this step, by the budget
  // Foreseen [s]; 0 before the first.
  double before_ = 0.0;   ///< from the start of a period to the first sweeps
  double between_ = 0.0;  ///< from the end of sweeps to the next step's
  double after_ = 0.0;    ///< from the end of sweeps to that of the period
  double more_ = 0.0;     ///< time that sweeps beyond kLeastSweeps took in this period [s]
  double least_ = 0.0;
  int periods_ = 0;                  ///< in least_
  double open_ = 0.0, force_ = 0.0;  ///< error and force of the last few steps, in the mean [N s]
  double largest_ = 0.0;             ///< largest force_ so far
  std::uint64_t all_cut_ = 0;        ///< since the start of the run
  double dt_ = 0.0;                  ///< length of the step under way [s]
  std::vector<CutStep> cut_;
  double cut_error_ = 0.0;
  std::optional<std::vector<CutStep>> recorded_;
};

}  // namespace mpm
