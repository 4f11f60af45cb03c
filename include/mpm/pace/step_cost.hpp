// What a step of a run costs on this machine, timed on steps of the run itself.
//
// A Simulation that serves for nothing else makes steps for a part of a second, so contact, law, shape function,
// precision and threads are those of the scene. Weak: a tool that touches nothing yet costs nothing yet, material that
// sleeps costs nothing until it wakes, what else the machine does meanwhile counts, and outputs are not in it. The
// first two are noted.
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
  bool touched = true;            ///< whether a rigid body was in contact then
};

/// A clock that never runs backwards [s].
using WallClock = std::function<double()>;
double steady_seconds();

class StepTimer {
 public:
  /// Times for `budget` [s] of `clock`, and one step at least unless over_budget() ends it. `stop`: as
  /// SimulationOptions::stop has it; may be empty.
  explicit StepTimer(double budget, std::function<bool()> stop = {}, WallClock clock = steady_seconds);

  /// To be asked as SimulationOptions::stop of the simulation that is timed.
  bool after_step();
  /// To be asked as its SimulationOptions::interrupt, so that a step of many stages ends, too: with the budget, and the
  /// first one, without which nothing is known, with ten times that.
  bool over_budget() const {
    return (timing_ && clock_() - begun_ >= (steps_ > 0 ? 1.0 : kFirstStep) * budget_) || stopped();
  }
  /// Advances the simulation until the budget is spent, the scene has ended, or it fails; it cannot go on afterwards.
  /// The first step allocates, and counts only where there is no other. Returns nothing when not one step was made.
  /// @throws StoppedError when `stop` was true
  std::optional<StepCost> time(Simulation& simulation);

 private:
  static constexpr double kFirstStep = 10.0;  ///< budgets

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
