#include "mpm_ros/run/expected_pace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "mpm/advice/target_record.hpp"
#include "mpm/pace/kept_costs.hpp"
#include "mpm/simulation/threads.hpp"
#include "mpm_ros/aim/scene_rehearsal.hpp"
#include "mpm_ros/run/budget_watch.hpp"
#include "mpm_ros/run/stop_signals.hpp"

namespace mpm_ros {

namespace {

using mpm::pace::Forecast;

constexpr std::size_t kMostTimed = 1'000'000;     ///< particles; to build a copy of more takes too long
constexpr std::uint64_t kMostCompared = 200'000;  ///< the same, for several copies
constexpr double kComparingBudget = 0.15;         ///< [s] for each of them
constexpr double kRehearsalOfNode = 0.6;          ///< [s] before a node's run begins
constexpr double kOfRun = 0.02;                   ///< part of a run's wall time that a rehearsal for --explain takes,
constexpr double kShortRehearsal = 2.0, kLongRehearsal = 40.0;  ///< within these bounds [s]

std::string timed_text(const Forecast& forecast, std::int64_t ago) {
  return fmt::format("{} step{} timed{}", forecast.cost.steps, forecast.cost.steps == 1 ? "" : "s",
                     ago > 0 ? " " + mpm::pace::duration_text(static_cast<double>(ago)) + " ago" : "");
}

Forecast forecast_of(const mpm::Scene& scene, const mpm::pace::StepCost& cost, std::uint64_t particles, int threads) {
  Forecast forecast;
  forecast.cost = cost;
  forecast.particles = particles;
  forecast.threads = threads;
  forecast.simulated = scene.definition.time.end;
  forecast.sleeps = scene.definition.sleep.has_value();
  forecast.tools = !scene.definition.rigid_bodies.empty();
  return forecast;
}

/// Makes a forecast by the first steps one of the whole run, where what is to come may change their cost. Returns true
/// if it did.
bool rehearse(const mpm::Scene& scene, mpm::Isa isa, double budget, const std::function<bool()>& stop,
              Forecast& forecast) {
  if (!forecast.changes()) return false;
  const auto found = rehearse_scene(scene, forecast, isa, budget, stop);
  if (found) forecast.cost = mpm::pace::of_whole_run(forecast.cost, *found, forecast.particles);
  return found.has_value();
}

std::size_t count(const mpm::SimulationDefinition& definition) {
  std::size_t particles = 0;
  for (const mpm::DeformableBody& body : definition.bodies) particles += body.positions.size();
  return particles;
}

/// Times as fast as `before`, where there is a copy that was timed.
std::optional<double> faster(const Forecast& before, const mpm::SimulationDefinition& definition, int threads,
                             mpm::Isa isa) {
  const auto after = mpm::pace::time_copy(definition, threads, isa, kComparingBudget, stop_overdue);
  if (!after) return std::nullopt;
  return after->real_time_factor() / before.real_time_factor();
}

mpm::pace::TimedFactors compare(const mpm::Scene& scene, const Forecast& before, int threads, mpm::Isa isa) {
  mpm::pace::TimedFactors timed;
  const mpm::SimulationDefinition built = mpm::build(scene, nullptr, stop_overdue);
  try {
    if (threads > before.threads) timed.threads = faster(before, built, threads, isa);
    mpm::SimulationDefinition changed = built;
    changed.method.precision = mpm::Precision::float32;
    if (built.method.precision != changed.method.precision) timed.single = faster(before, changed, before.threads, isa);
    changed = built;
    changed.method.update = mpm::UpdateScheme::usf;
    if (built.method.update == mpm::UpdateScheme::usavg) timed.usf = faster(before, changed, before.threads, isa);
  } catch (const mpm::StoppedError&) {
    throw;
  } catch (const mpm::Error&) {
    // A method that there is not: it will not be proposed.
  } catch (const std::bad_alloc&) {
    // Leaves out of the proposals what there is no room to time.
  }
  return timed;
}

std::string budget_text(const mpm::SweepBudget& budget) {
  if (!budget.least()) return "budget: too few sync periods were timed to say whether ten sweeps a step fit\n";
  const std::string problem = short_budget(budget);
  return problem.empty() ? fmt::format("budget: of {} a sync period takes {} with ten sweeps a step\n",
                                       milliseconds(budget.seconds()), milliseconds(*budget.least()))
                         : "warning: " + problem + "\n";
}

}  // namespace

std::optional<ExpectedPace> expected_pace(const mpm::Scene& scene, const RunOptions& options, double wanted,
                                          bool may_time) {
  const mpm::pace::KeptCosts costs(mpm::pace::kept_costs_path());
  const mpm::Isa isa = mpm::choose_isa(options.isa);
  const std::string key = mpm::pace::cost_key(mpm::text_without_target(scene), isa, options.threads);
  const std::int64_t now = mpm::pace::wall_time();
  ExpectedPace pace;
  std::int64_t when = now;
  const auto kept = costs.find(key, now);
  if (kept) {
    pace.forecast = forecast_of(scene, kept->cost, kept->particles, kept->threads);
    when = kept->when;
  } else if (may_time) {
    try {
      mpm::SimulationDefinition built = mpm::build(scene, nullptr, options.stop);
      if (count(built) > kMostTimed) return std::nullopt;
      const auto timed = mpm::pace::time_copy(std::move(built), options.threads, isa, kTimingBudget, options.stop);
      if (!timed) return std::nullopt;
      pace.forecast = *timed;
    } catch (const mpm::StoppedError&) {
      throw;
    } catch (const mpm::Error&) {
      return std::nullopt;  // the run will say what is wrong
    } catch (const std::bad_alloc&) {
      return std::nullopt;  // this too
    }
  } else {
    return std::nullopt;
  }
  if (may_time && (rehearse(scene, isa, kRehearsalOfNode, options.stop, pace.forecast) || !kept)) {
    costs.keep(key, {pace.forecast.cost, pace.forecast.threads, pace.forecast.particles, when});
  }
  pace.origin = timed_text(pace.forecast, now - when);
  pace.plan =
      mpm::pace::make_plan(scene.definition, pace.forecast, wanted, mpm::useful_threads(pace.forecast.particles));
  return pace;
}

std::string expected_text(const ExpectedPace& pace) {
  return fmt::format("{}; {}", mpm::pace::forecast_text(pace.forecast), pace.origin);
}

std::string pace_warning(const ExpectedPace& pace) {
  if (pace.plan.together.empty()) return {};
  const std::string wanted =
      pace.plan.wanted == 1.0 ? "real time" : fmt::format("a pace of {:g} of real time", pace.plan.wanted);
  return fmt::format("{} is not in reach: {}. {}; `run_scene SCENE --explain` says at what price", wanted,
                     expected_text(pace), mpm::pace::plan_text(pace.plan));
}

void keep_reached_pace(const mpm::Scene& scene, int threads_asked, const mpm::Simulation& simulation) {
  const mpm::pace::KeptCosts costs(mpm::pace::kept_costs_path());
  if (costs.path().empty() || simulation.time() == 0) return;
  const mpm::SolverState state = simulation.state();
  const double simulated = mpm::seconds_of(state.time), steps = static_cast<double>(state.step.steps);
  const std::string key =
      mpm::pace::cost_key(mpm::text_without_target(scene), mpm::choose_isa(simulation.isa()), threads_asked);
  const std::int64_t now = mpm::pace::wall_time();
  if (const auto kept = costs.find(key, now); kept && kept->cost.steps > state.step.steps) return;
  const mpm::pace::StepCost cost{state.wall_seconds / steps, steps / simulated, state.step.steps};
  costs.keep(key, {cost, simulation.threads(), state.particles, now});
}

std::string explain_pace(const mpm::Scene& scene, mpm::Simulation& simulation, mpm::pace::StepTimer& timer,
                         int threads) {
  const auto cost = timer.time(simulation);
  if (!cost) return "pace: not one step could be timed\n";
  const Forecast timed_now = forecast_of(scene, *cost, simulation.particles(), simulation.threads());
  const mpm::Isa isa = mpm::choose_isa(simulation.isa());
  const mpm::pace::KeptCosts costs(mpm::pace::kept_costs_path());
  const std::string key = mpm::pace::cost_key(mpm::text_without_target(scene), isa, threads);
  const std::int64_t now = mpm::pace::wall_time();
  Forecast forecast = timed_now;
  std::int64_t ago = 0;
  bool kept = true;
  if (const auto before = costs.find(key, now); before && before->cost.steps > cost->steps) {
    forecast.cost = before->cost;
    forecast.threads = before->threads;
    ago = now - before->when;
  } else {
    const double seconds = forecast.wall_seconds() / std::max(cost->awake, 1e-3);
    rehearse(scene, isa, std::clamp(kOfRun * seconds, kShortRehearsal, kLongRehearsal), stop_overdue, forecast);
    kept = costs.keep(key, {forecast.cost, forecast.threads, forecast.particles, now});
  }
  std::string text = fmt::format("pace: {}; {}, without outputs{}\n", mpm::pace::forecast_text(forecast),
                                 timed_text(forecast, ago), kept ? ", kept for a day in " + costs.path() : "");
  if (simulation.budget() != nullptr) text += budget_text(*simulation.budget());
  if (forecast.real_time_factor() >= 1.0) return text;
  const int useful = mpm::useful_threads(forecast.particles);
  const auto timed =
      forecast.particles <= kMostCompared ? compare(scene, timed_now, useful, isa) : mpm::pace::TimedFactors();
  const mpm::pace::Plan plan = mpm::pace::make_plan(scene.definition, forecast, 1.0, useful, timed);
  text += "real time is not in reach; what would bring it nearer, the least harmful first:\n" +
          mpm::pace::plan_table(plan, forecast);
  const auto chosen = [](const auto& choice) { return choice.first == "method"; };
  if (std::any_of(scene.choices.begin(), scene.choices.end(), chosen)) {
    text +=
        "the method was chosen for this scene, and a key of `method` set by itself turns the choice off: write\n"
        "--set method.auto={} before it, and the rest is still chosen\n";
  }
  return text;
}

}  // namespace mpm_ros
