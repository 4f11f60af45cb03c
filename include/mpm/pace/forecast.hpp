// Duration of a run, and its pace: simulated over wall time.
//
// A forecast and no promise: it takes the steps that were timed for all the others. Stepping alone, without outputs.
// Others may cost more or less: where a tool has not touched yet, or material sleeps or will. A rehearsal foresees that
// (rehearsal.hpp); where there was none, the reasons are said with the forecast.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "mpm/pace/step_cost.hpp"

namespace mpm::pace {

struct Forecast {
  static constexpr double kOfRun = 0.5;  ///< part of a run's steps

  StepCost cost;
  std::uint64_t particles = 0;
  int threads = 1;
  double simulated = 0.0;  ///< time that is to be simulated [s]; 0: it has no end
  bool sleeps = false;     ///< true if material may sleep
  bool tools = false;      ///< true if there are rigid bodies

  double steps() const { return simulated * cost.steps_per_second; }
  double wall_seconds() const { return steps() * cost.step_seconds; }
  /// True if the steps that were timed are so many of the run's that they stand for it.
  bool of_run() const { return simulated > 0.0 && static_cast<double>(cost.steps) >= kOfRun * steps(); }
  /// True if the cost of a step may change in what is to come, so that a rehearsal is worth its time.
  bool changes() const {
    return simulated > 0.0 && !of_run() && cost.rehearsed == 0.0 && (sleeps || (tools && !cost.touched));
  }
  /// Simulated over wall time, as far as stepping sets it.
  double real_time_factor() const { return 1.0 / (cost.step_seconds * cost.steps_per_second); }
};

/// Times a copy of a run, unsettled, that is built for this alone and freed again. Takes the time to build it besides
/// the budget [s] (StepTimer). Returns nothing when not one step was made.
/// `ranks`: null for this process alone; else all of them time it together, by the clock of the first, and have the
/// same result; the definition is that which build() made for them, and a stop is that of any.
/// @throws Error as Simulation has it, StoppedError when `stop` was true
std::optional<Forecast> time_copy(SimulationDefinition definition, int threads, std::optional<Isa> isa, double budget,
                                  const std::function<bool()>& stop, Communicator* ranks = nullptr);

/// "0.13 of real time expected on 2 threads; 1.5 s will take 11 s of wall time (2084 steps of 5.4 ms)", and what it
/// does not know.
std::string forecast_text(const Forecast& forecast);
/// A duration as one reads it: "3.4 ms", "11 s", "4 min", "2.5 h".
std::string duration_text(double seconds);

}  // namespace mpm::pace
