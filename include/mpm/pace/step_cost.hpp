// Cost of a step of a run on this machine, timed on steps of the run itself.
//
// A Simulation that serves for nothing else makes steps for a part of a second, so contact, law, shape function,
// precision and threads are those of the scene. Weak: a tool that touches nothing yet costs nothing yet, material that
// sleeps costs nothing until it wakes, what else the machine does meanwhile counts, and outputs are not in it. The
// first two are noted, and a rehearsal (rehearsal.hpp) tells how they will be.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "mpm/simulation/simulation.hpp"

namespace mpm::pace {

struct StepCost {
  double step_seconds = 0.0;      ///< wall time of a step [s]
  double steps_per_second = 0.0;  ///< steps in a second of simulated time [1/s]
  std::uint64_t steps = 0;        ///< steps that were timed
  double awake = 1.0;             ///< part of the particles that did not sleep at the end of them
  bool touched = true;            ///< true if a rigid body was in contact then
  double rehearsed = 0.0;  ///< if positive, it is of the whole run, by a rehearsal in cells so many times as wide
};

/// Part of the particles that does not sleep.
double part_awake(const Simulation& simulation);
/// True if a rigid body has been in contact since this was asked last.
bool touches(Simulation& simulation);

/// A clock that never runs backwards [s].
using WallClock = std::function<double()>;
double steady_seconds();

class StepTimer {
 public:
  /// Times for `budget` [s] of `clock`, or ten times that where it is not enough for kFewSteps, and one step at least
  /// unless over_budget() ends it. `stop`: as
  /// SimulationOptions::stop has it; may be empty.
  explicit StepTimer(double budget, std::function<bool()> stop = {}, WallClock clock = steady_seconds);

  /// To be asked as SimulationOptions::stop of the simulation that is timed.
  bool after_step();
  /// To be asked as its SimulationOptions::interrupt, so that a step of many stages ends, too.
  bool over_budget() const { return (timing_ && over(clock_())) || stopped(); }
  /// Advances the simulation until the budget is spent, the scene has ended, or it fails; it cannot go on afterwards.
  /// The first step allocates, and counts only where there is no other. Returns nothing when not one step was made.
  /// @throws StoppedError when `stop` was true
  std::optional<StepCost> time(Simulation& simulation);

 private:
  static constexpr double kForFewSteps = 10.0;  ///< budgets
  static constexpr std::uint64_t kFewSteps = 5;

  bool over(double now) const { return now - begun_ >= (steps_ >= kFewSteps ? 1.0 : kForFewSteps) * budget_; }

  void count();
  bool stopped() const { return stop_ && stop_(); }

  const double budget_;
  const std::function<bool()> stop_;
  const WallClock clock_;
  bool timing_ = false;
  double begun_ = 0.0, first_ = 0.0, last_ = 0.0;  // [s] of the clock; ends of the first step and of the last
  std::uint64_t steps_ = 0;
};

}  // namespace mpm::pace
