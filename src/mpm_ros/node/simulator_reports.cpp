// Reports of the node on its run: what starts and at what pace, overload, the end of a bag, and numbers for
// /diagnostics.
#include <fmt/format.h>
#include <ros/console.h>

#include <cstdio>
#include <utility>

#include "mpm_ros/node/simulator_node.hpp"
#include "mpm_ros/node/start_line.hpp"
#include "mpm_ros/run/budget_watch.hpp"

namespace mpm_ros {

namespace {

/// Time until the node says again that it is late.
constexpr std::chrono::seconds kOverloadAgain{10};
/// Part of a sync period's wall time that leaves time for outputs.
constexpr double kBudgetOfPeriod = 0.8;
/// Length of a run after which its pace is told.
constexpr double kFirstSecond = 1.0;  // [s]

}  // namespace

void SimulatorNode::tell_start(const std::optional<ExpectedPace>& expected) const {
  const mpm::Scene& scene = subject_->scene;
  StartFacts facts;
  facts.scene = scene.definition.name;
  facts.particles = run_->simulation().particles();
  facts.pacing = parameters_.pacing;
  facts.real_time_factor = parameters_.real_time_factor;
  facts.ranks = ranks_ ? ranks_->size() : 1;
  facts.threads = run_->simulation().threads();
  facts.name_space = node_.getNamespace();
  facts.end = scene.definition.time.end;
  facts.paused = paused_;
  facts.clock = parameters_.publish_clock && ros::Time::isSimTime();
  facts.commands = parameters_.commands;
  facts.heights = heights_.from;
  const std::vector<std::string> names = mpm::commanded_names(scene);
  for (std::size_t body = 0; body < scene.commands.size(); ++body) {
    if (!scene.commands[body].frame.empty()) facts.frames.emplace_back(names[body], scene.commands[body].frame);
  }
  ROS_INFO_STREAM(start_line(facts));
  const bool paced = parameters_.pacing == Pacing::real_time;
  if (scene.definition.time.budget) tell_budget();
  if (const std::string warning = expected && paced ? pace_warning(*expected) : ""; !warning.empty()) {
    ROS_WARN_STREAM(warning);
  } else if (expected && paced) {
    ROS_INFO_STREAM(fmt::format("up to {:.2g} of real time expected, so the pace asked for can be kept; {}",
                                expected->forecast.real_time_factor(), expected->origin));
  } else if (expected) {
    ROS_INFO_STREAM(expected_text(*expected));
  }
  std::fflush(stdout);  // a pipe would keep it until the run has long begun
}

void SimulatorNode::tell_budget() const {
  const double budget = *subject_->scene.definition.time.budget;
  const double period = mpm::seconds_of(run_->simulation().sync_period()) / parameters_.real_time_factor;
  if (parameters_.pacing == Pacing::real_time && budget >= period) {
    ROS_WARN_STREAM(
        fmt::format("time.budget: {} leaves no time for outputs in a sync period, for which there are {}; "
                    "write {} or less",
                    milliseconds(budget), milliseconds(period), milliseconds(kBudgetOfPeriod * period)));
  }
  if (!parameters_.commands.empty()) {
    ROS_WARN_STREAM(
        "~commands: the scene has a time.budget, by which sweeps end at other times than in the recording; "
        "run_scene --from-bag makes it again to the bit");
  }
}

void SimulatorNode::tell_pace() {
  if (pace_told_ || parameters_.pacing != Pacing::free || run_->ended() || run_->wall_seconds() < kFirstSecond) return;
  pace_told_ = true;
  const double factor = run_->real_time_factor(), now = mpm::seconds_of(run_->simulation().time());
  const double end = subject_->scene.definition.time.end;
  std::string text = fmt::format("the run goes at {:.2g} of real time", factor);
  if (end > now) {
    text += fmt::format("; to {:g} s it will take {} more", end, mpm::pace::duration_text((end - now) / factor));
  }
  ROS_INFO_STREAM(text);
  std::fflush(stdout);
}

void SimulatorNode::tell_overload() {
  if (std::exchange(given_up_seen_, pacer_->given_up()) == pacer_->given_up()) return;
  const Pacer::Clock::time_point now = Pacer::Clock::now();
  if (overload_told_ && now < *overload_told_ + kOverloadAgain) return;
  overload_told_ = now;
  ROS_WARN_STREAM(fmt::format(
      "at {:g} s the run is {:.2g} s late, more than is caught up with, and goes on so much behind the "
      "wall clock. If this "
      "goes on, lower _real_time_factor, give the scene a target (_set:=target.real_time=1), or see what "
      "would help with "
      "run_scene --explain",
      mpm::seconds_of(run_->simulation().time()), std::chrono::duration<double>(pacer_->last_delay()).count()));
}

void SimulatorNode::say_closed() const {
  const BagRecorder* recorder = run_->recorder();
  if (recorder != nullptr && recorder->failure().empty()) ROS_INFO_STREAM("the bag is closed: " << run_->bag());
}

void SimulatorNode::count_commands() {
  const LateCommands late = commands_.late();
  run_->count_commands(late.unstamped + late.past, health_.refused(), commands_.dropped());
  run_->count_overruns(pacer_->overruns());
}

void SimulatorNode::report() {
  SolverHealth solver;
  switch (phase()) {
    case Phase::running:
      solver.phase = "running";
      break;
    case Phase::paused:
      solver.phase = "paused";
      break;
    case Phase::waiting:
      solver.phase = "waiting for step";
      break;
    case Phase::ended:
      solver.phase = "ended";
      break;
    case Phase::failed:
      solver.phase = "failed: " + failure_;
      solver.failed = true;
      break;
  }
  solver.time = mpm::seconds_of(run_->simulation().time());
  solver.real_time_factor = run_->real_time_factor();
  if (parameters_.pacing == Pacing::real_time && phase() == Phase::running) {
    solver.asked_factor = parameters_.real_time_factor;
  }
  solver.overruns = pacer_->overruns();
  if (const BagRecorder* recorder = run_->recorder()) solver.record_failure = recorder->failure();
  if (!parameters_.record_required && !solver.record_failure.empty() && !std::exchange(record_lost_, true)) {
    ROS_ERROR_STREAM(solver.record_failure << ". The run goes on without a record");
  }
  const SolverState& state = run_->outputs().solver_state();
  solver.steps = state.steps;
  solver.step = state.dt;
  solver.step_limited_by = state.dt_limited_by;
  solver.precision = run_->simulation().definition().method.precision;
  solver.momentum_error = state.momentum_error;
  solver.min_j = state.min_j;
  solver.courant = state.courant;
  solver.particles = state.particles;
  solver.returned = state.particles_returned;
  if (const mpm::SweepBudget* budget = run_->simulation().budget()) {
    solver.short_budget = short_budget(*budget);
    solver.cut_error = budget->cut_error();
  }
  health_.set_solver(solver);

  const LateCommands late = commands_.late();
  health_.set_commands({late.unstamped, late.past, commands_.waiting(), CommandQueue::kMost,
                        mpm::seconds_of(CommandQueue::kHorizon), commands_.dropped(), commands_.missing(),
                        commands_.dropped_transforms()});
}

}  // namespace mpm_ros
