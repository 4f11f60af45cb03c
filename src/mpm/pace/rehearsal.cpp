#include "mpm/pace/rehearsal.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace mpm::pace {

namespace {

constexpr double kLastPart = 0.75;    ///< part of the time reached; what follows goes on as it was from there on
constexpr double kLeastAwake = 0.05;  ///< part of the particles, from which on their cost can be told from a step's
constexpr double kLooks = 40.0;       ///< at the tools in a run
constexpr double kLeastSteps = 20.0;  ///< with and without contact, from which on their costs can be compared

/// Counts of one sync period.
struct Period {
  double steps = 0.0, awake = 0.0, wall = 0.0;
  bool touched = false;
};

/// Sums over periods.
struct Sums {
  double steps = 0.0, awake = 0.0, touched = 0.0, count = 0.0;
  double free_wall = 0.0, free_steps = 0.0, touched_wall = 0.0, touched_steps = 0.0;  ///< steps times what is awake
  void add(const Period& one, double times) {
    count += times;
    steps += times * one.steps;
    awake += times * one.steps * one.awake;
    touched += times * (one.touched ? one.steps : 0.0);
    (one.touched ? touched_wall : free_wall) += times * one.wall;
    (one.touched ? touched_steps : free_steps) += times * one.steps * one.awake;
  }
};

Rehearsal of_periods(const std::vector<Period>& periods, double all) {
  const auto reached = static_cast<double>(periods.size());
  const auto from = static_cast<std::size_t>(kLastPart * reached);
  const double again = std::max(0.0, all - reached) / (reached - static_cast<double>(from));
  Sums sums;
  for (std::size_t i = 0; i < periods.size(); ++i) sums.add(periods[i], i < from ? 1.0 : 1.0 + again);
  Rehearsal found;
  found.awake = sums.awake / sums.steps;
  found.touched = sums.touched / sums.steps;
  found.steps = sums.steps / sums.count / periods.front().steps;
  found.particle_step = (sums.free_wall + sums.touched_wall) / (sums.free_steps + sums.touched_steps);
  if (sums.steps - sums.touched > kLeastSteps && sums.touched > kLeastSteps) {
    const double without = sums.free_wall / sums.free_steps;
    found.contact = std::max(1.0, sums.touched_wall / sums.touched_steps / without);
  }
  return found;
}

}  // namespace

std::optional<Rehearsal> rehearse(SimulationDefinition coarse, double coarser, int threads, std::optional<Isa> isa,
                                  double budget, const std::function<bool()>& stop, const WallClock& clock,
                                  bool with_tools) {
  const double end = coarse.time.end / kNanosecond, begun = clock();
  const auto stopped = [&] { return stop && stop(); };
  const auto over = [&] { return clock() - begun >= budget || stopped(); };
  SimulationOptions options;
  options.threads = threads;
  options.isa = isa;
  options.stop = over;
  options.interrupt = over;
  std::vector<Period> periods;
  double all = 0.0, particles = 0.0;
  std::optional<Simulation> run;
  std::optional<ToolsInGround> tools;
  try {
    Simulation& simulation = run.emplace(std::move(coarse), options);
    particles = static_cast<double>(simulation.particles());
    if (with_tools) tools.emplace(simulation);
    double last = clock(), look = end / kLooks;
    std::uint64_t steps = 0;
    while (static_cast<double>(simulation.time()) < end) {
      simulation.advance();
      const double now = clock();
      const std::uint64_t made = simulation.state().step.steps;
      periods.push_back({static_cast<double>(made - steps), part_awake(simulation), now - last, touches(simulation)});
      last = now;
      steps = made;
      if (tools && static_cast<double>(simulation.time()) >= look) {
        tools->look(simulation);
        look += end / kLooks;
        last = clock();  // it is no part of a period
      }
      all = end / static_cast<double>(simulation.time()) * static_cast<double>(periods.size());
    }
  } catch (const StoppedError&) {
    // Its time is over.
  } catch (const Error&) {
    // Periods until it failed count; a scene that a coarse grid cannot have has none.
  }
  if (stopped()) throw StoppedError("stopped while the run was rehearsed");
  if (periods.empty()) return std::nullopt;
  Rehearsal found = of_periods(periods, all);
  found.coarser = coarser;
  found.reached = std::min(1.0, static_cast<double>(periods.size()) / all);
  found.wall = clock() - begun;
  found.particle_step /= particles;
  if (tools) {
    tools->look_ahead(*run, end * kNanosecond);
    found.tools = tools->found();
  }
  return found;
}

StepCost of_whole_run(const StepCost& start, const Rehearsal& rehearsal, std::uint64_t particles) {
  StepCost whole = start;
  whole.steps_per_second *= rehearsal.steps;
  if (start.awake < kLeastAwake) {
    whole.step_seconds =
        std::max(start.step_seconds, rehearsal.particle_step * rehearsal.awake * static_cast<double>(particles));
  } else {
    // Points of contact lie on surfaces: their part of a step's cost falls with the cell.
    const double dearer = start.touched ? 0.0 : rehearsal.touched * (rehearsal.contact - 1.0) / rehearsal.coarser;
    whole.step_seconds *= rehearsal.awake / start.awake * (1.0 + dearer);
  }
  whole.awake = rehearsal.awake;
  whole.touched = start.touched || rehearsal.touched > 0.0;
  whole.rehearsed = rehearsal.coarser;
  return whole;
}

double awake_by(const Rehearsal& coarse, const Rehearsal& fine, int axes) {
  const double power = std::log(coarse.awake / fine.awake) / std::log(coarse.coarser / fine.coarser);
  return fine.awake / std::pow(fine.coarser, std::clamp(power, 0.0, static_cast<double>(axes)));
}

double cell_factor(double seconds, double budget, int axes) {
  return std::pow(seconds / budget, 1.0 / (1.0 + static_cast<double>(axes)));
}

}  // namespace mpm::pace
