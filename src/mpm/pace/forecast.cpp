#include "mpm/pace/forecast.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <utility>

#include "mpm/ranks/of_all.hpp"

namespace mpm::pace {

namespace {

constexpr int kUsualSweeps = 30;  ///< sweeps of an implicit step in the mean of blade_in_soil and wheel_in_sand

/// A timer that comes to the same on all ranks.
StepTimer make_timer(double budget, const std::function<bool()>& stop, Communicator* ranks) {
  if (ranks == nullptr) return StepTimer(budget, stop);
  const auto clock = [ranks] {
    return largest_of_all(ranks, ranks->first() ? steady_seconds() : -std::numeric_limits<double>::infinity());
  };
  return StepTimer(
      budget, [ranks, stop] { return ranks->any(stop && stop()); }, clock);
}

}  // namespace

std::optional<Forecast> time_copy(SimulationDefinition definition, int threads, std::optional<Isa> isa, double budget,
                                  const std::function<bool()>& stop, Communicator* ranks) {
  StepTimer timer = make_timer(budget, stop, ranks);
  SimulationOptions options;
  options.threads = threads;
  options.isa = isa;
  options.settle = false;
  if (ranks != nullptr) options.ranks = {ranks, [](Communicator*) {}};  // owned by others, who outlive the copy
  options.stop = [&timer] { return timer.after_step(); };
  options.interrupt = [&timer] { return timer.over_budget(); };
  // Soil that has not settled falls in its first implicit steps, which takes more sweeps than are usual.
  if (definition.method.update == UpdateScheme::implicit && !definition.method.sweeps)
    definition.method.sweeps = kUsualSweeps;
  Forecast forecast;
  forecast.simulated = definition.time.end;
  forecast.sleeps = definition.sleep.has_value();
  forecast.tools = !definition.rigid_bodies.empty();
  Simulation copy(std::move(definition), options);
  forecast.particles = copy.particles();
  forecast.threads = copy.threads();
  const std::optional<StepCost> cost = timer.time(copy);
  if (!cost) return std::nullopt;
  forecast.cost = *cost;
  return forecast;
}

std::string duration_text(double seconds) {
  constexpr std::array<std::pair<double, const char*>, 4> kUnits{
      {{86400.0, "d"}, {3600.0, "h"}, {60.0, "min"}, {1.0, "s"}}};
  constexpr double kAtLeast = 1.95;  // least number of a unit, so that "90 s" is not "1.5 min"
  for (const auto& [unit, name] : kUnits) {
    if (seconds >= kAtLeast * unit) return fmt::format("{:.3g} {}", seconds / unit, name);
  }
  constexpr double kRounds = 0.9995;  // part of a unit that would be written as 1000 of the unit below
  if (seconds >= kRounds) return fmt::format("{:.3g} s", seconds);
  return seconds >= 1e-3 * kRounds ? fmt::format("{:.3g} ms", 1e3 * seconds) : fmt::format("{:.3g} us", 1e6 * seconds);
}

namespace {

constexpr double kMostlyAwake = 0.9;  ///< part of the particles: fewer sleep than make a difference

/// Reasons why other steps than those that were timed may cost more or less.
std::string unknown_text(const Forecast& forecast) {
  if (forecast.of_run()) return {};
  const StepCost& cost = forecast.cost;
  if (cost.rehearsed > 0.0) {
    return fmt::format(
        "; as a rehearsal in cells {:.2g} times as wide foresees it, with {:.0f} % of the material awake",
        cost.rehearsed, 100.0 * cost.awake);
  }
  std::string text;
  if (forecast.sleeps && forecast.cost.awake < kMostlyAwake) {
    text += fmt::format(
        "; {:.0f} % of the material slept when its steps were timed, and what wakes costs more: down to "
        "{:.2g} of real time where all is awake",
        100.0 * (1.0 - forecast.cost.awake), forecast.real_time_factor() * forecast.cost.awake);
  } else if (forecast.sleeps) {
    text +=
        "; hardly anything slept when its steps were timed, and what falls asleep makes it faster, up to several times";
  }
  if (forecast.tools && !forecast.cost.touched) {
    text += "; no tool touched when its steps were timed, and contact and what it sets in motion make it slower";
  }
  return text;
}

}  // namespace

std::string forecast_text(const Forecast& forecast) {
  std::string text = fmt::format("{:.2g} of real time expected on {} thread{}", forecast.real_time_factor(),
                                 forecast.threads, forecast.threads == 1 ? "" : "s");
  const std::string step = duration_text(forecast.cost.step_seconds);
  if (!(forecast.simulated > 0.0)) {
    return text + fmt::format(" ({:.3g} steps of {} a simulated second)", forecast.cost.steps_per_second, step) +
           unknown_text(forecast);
  }
  return text +
         fmt::format("; {:g} s will take {} of wall time ({:.0f} steps of {})", forecast.simulated,
                     duration_text(forecast.wall_seconds()), forecast.steps(), step) +
         unknown_text(forecast);
}

}  // namespace mpm::pace
