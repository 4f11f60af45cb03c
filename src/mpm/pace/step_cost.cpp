#include "mpm/pace/step_cost.hpp"

#include <chrono>
#include <utility>

namespace mpm::pace {

namespace {

constexpr std::uint64_t kPlentyOfSteps = 2000;  ///< more make the mean no better

}  // namespace

double part_awake(const Simulation& simulation) {
  const auto particles = static_cast<double>(simulation.particles());
  for (const NamedNumber& number : simulation.numbers()) {
    if (number.name == "asleep") return 1.0 - number.value / particles;
  }
  return 1.0;
}

bool touches(Simulation& simulation) {
  const std::size_t bodies = simulation.bodies().size();
  for (std::size_t b = 0; b < bodies; ++b) {
    if (simulation.take_contact(static_cast<int>(b)).nodes > 0) return true;
  }
  return false;
}

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

StepTimer::StepTimer(double budget, std::function<bool()> stop, WallClock clock)
    : budget_(budget), stop_(std::move(stop)), clock_(std::move(clock)) {}

void StepTimer::count() {
  last_ = clock_();
  if (++steps_ == 1) first_ = last_;
}

bool StepTimer::after_step() {
  if (!timing_) return stopped();
  count();
  return over(last_) || steps_ >= kPlentyOfSteps || stopped();
}

std::optional<StepCost> StepTimer::time(Simulation& simulation) {
  const double end = simulation.definition().time.end / kNanosecond;
  timing_ = true;
  steps_ = 0;
  begun_ = clock_();
  try {
    do {
      simulation.advance();
      count();  // after the last step of a sync period nobody is asked
    } while (!over(last_) && steps_ < kPlentyOfSteps && !stopped() &&
             (end <= 0.0 || static_cast<double>(simulation.time()) < end));
  } catch (const StoppedError&) {
    // By after_step() or over_budget().
  } catch (const PhysicsError&) {
    // The run itself will tell of it.
  }
  timing_ = false;
  if (stopped()) throw StoppedError("stopped while its steps were timed");
  const double dt = simulation.state().step.dt_last;
  if (steps_ == 0 || !(dt > 0.0)) return std::nullopt;
  StepCost cost;
  cost.steps = steps_ > 1 ? steps_ - 1 : 1;
  cost.step_seconds = (last_ - (steps_ > 1 ? first_ : begun_)) / static_cast<double>(cost.steps);
  cost.steps_per_second = 1.0 / dt;
  cost.awake = part_awake(simulation);
  cost.touched = touches(simulation);
  return cost;
}

}  // namespace mpm::pace
