#include "mpm_ros/node/simulator_node.hpp"

#include <fmt/format.h>
#include <ros/console.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <thread>
#include <utility>

#include "mpm_ros/message/bag_parts.hpp"
#include "mpm_ros/message/topics.hpp"
#include "mpm_ros/run/output_names.hpp"
#include "mpm_ros/run/run_scene_checkpoint.hpp"

namespace mpm_ros {

namespace {

/// How long the solver's thread sleeps at most before it looks whether it is to stop.
constexpr std::chrono::milliseconds kGlance{50};
/// Steps that wait for messages hold one each; others are for who pauses or asks meanwhile.
constexpr std::uint32_t kServiceThreads = 4;
/// At the end: for messages and answers on their way out.
constexpr std::chrono::milliseconds kLinger{300};

}  // namespace

SimulatorNode::SimulatorNode(ros::NodeHandle node, const NodeParameters& parameters,
                             std::function<bool()> stop_requested)
    : node_(std::move(node)),
      parameters_(parameters),
      stop_requested_(std::move(stop_requested)),
      scene_(mpm::load_scene(parameters.scene, parameters.set)),
      clock_(node_, parameters.publish_clock, parameters.clock_rate),
      watch_(std::llround(parameters.command_timeout * 1e9)),
      paused_(parameters.start_paused) {
  if (!parameters_.commands.empty()) log_ = read_commands(parameters_.commands);
  if (const std::string problem = problem_of(run_options().output.particles); !problem.empty()) {
    throw ParameterError(fmt::format("parameter ~particle_fields, ~particle_stride or ~particle_region: {}", problem));
  }
  const std::string bag = run_options().bag;
  std::error_code ignored;
  for (const std::string& part : parts_of(parameters_.commands)) {
    if (std::filesystem::equivalent(bag, part, ignored))
      throw ParameterError(fmt::format("parameter ~record: {} is the bag of ~commands; choose another name", bag));
  }
  if (!parameters_.resume.empty() && std::filesystem::exists(bag, ignored))
    throw ParameterError(fmt::format("parameter ~record: {} holds the run so far; choose another name", bag));
  for (const mpm::RigidBodyDefinition& body : scene_.definition.rigid_bodies) bodies_.push_back(body.name);
  std::vector<std::string> frames;
  std::vector<mpm::MotionLimits> limits;
  for (const mpm::CommandDefinition& commanded : scene_.commands) {
    frames.push_back(commanded.frame);
    // What was recorded is within them already.
    if (log_.empty()) limits.push_back(commanded.limits);
  }
  limiter_ = std::make_unique<CommandLimiter>(std::move(limits), health_);

  if (parameters_.reset_time == ResetTime::zero && !ros::Time::isSimTime()) {
    throw ParameterError(
        "parameter ~reset_time is zero, but /use_sim_time is not set: the wall's clock cannot be set back");
  }

  ros::NodeHandle services(node_);
  services.setCallbackQueue(&service_callbacks_);
  ros::NodeHandle commands(node_);
  commands.setCallbackQueue(&topic_callbacks_);

  publishers_ =
      std::make_unique<Publishers>(services, bodies_, parameters_.wrench_cutoff > 0.0, !scene_.output.global.empty());
  queue_ = std::make_unique<CommandQueue>(scene_.definition.time.sync);
  start_run(parameters_.resume.empty() ? first_stamps() : stamps_from(mpm::read_checkpoint(parameters_.resume).time),
            parameters_.resume);
  for (const std::string& warning : run_->simulation().warnings()) ROS_WARN_STREAM(warning);
  for (const std::string& note : run_->simulation().notes()) ROS_INFO_STREAM(note);
  pacer_ = std::make_unique<Pacer>(run_->simulation().sync_period(), parameters_.real_time_factor);
  // A run that replays recorded commands listens to nobody else.
  if (log_.empty()) {
    bridge_ = std::make_unique<CommandBridge>(commands, bodies_, frames, parameters_.world_frame, *queue_, health_);
    bridge_->reader().set_stamps(run_->stamps());
  }

  services_.push_back(services.advertiseService(topics::kPause, &SimulatorNode::on_pause, this));
  services_.push_back(services.advertiseService(topics::kReset, &SimulatorNode::on_reset, this));
  services_.push_back(services.advertiseService(topics::kStep, &SimulatorNode::on_step, this));
  services_.push_back(services.advertiseService(topics::kSaveCheckpoint, &SimulatorNode::on_save_checkpoint, this));
  services_.push_back(services.advertiseService(topics::kLoadCheckpoint, &SimulatorNode::on_load_checkpoint, this));

  diagnostics_ = std::make_unique<diagnostic_updater::Updater>(services);
  diagnostics_->setHardwareID("none");
  diagnostics_->add("commands", [this](diagnostic_updater::DiagnosticStatusWrapper& s) { health_.fill_commands(s); });
  diagnostics_->add("solver", [this](diagnostic_updater::DiagnosticStatusWrapper& s) { health_.fill_solver(s); });
  timer_ = services.createSteadyTimer(ros::WallDuration(0.1), [this](const ros::SteadyTimerEvent&) { housekeeping(); });

  topic_spinner_ = std::make_unique<ros::AsyncSpinner>(1, &topic_callbacks_);
  service_spinner_ = std::make_unique<ros::AsyncSpinner>(kServiceThreads, &service_callbacks_);
  topic_spinner_->start();
  service_spinner_->start();
}

SimulatorNode::~SimulatorNode() {
  mailbox_.close();
  timer_.stop();
  if (topic_spinner_) topic_spinner_->stop();
  if (service_spinner_) service_spinner_->stop();
}

RunOptions SimulatorNode::run_options() const {
  RunOptions options;
  options.threads = parameters_.threads;
  options.isa = parameters_.isa;
  options.output = output_options(scene_);
  if (parameters_.particle_rate) options.output.particle_period = 1.0 / *parameters_.particle_rate;
  if (parameters_.particle_first) options.output.particle_first = *parameters_.particle_first;
  if (parameters_.particle_fields) options.output.particles.fields = *parameters_.particle_fields;
  if (parameters_.particle_stride) options.output.particles.choice.stride = *parameters_.particle_stride;
  if (parameters_.particle_region) options.output.particles.choice.region = *parameters_.particle_region;
  if (parameters_.wrench_rate > 0.0) options.output.wrench_period = 1.0 / parameters_.wrench_rate;
  options.output.wrench_cutoff = parameters_.wrench_cutoff;
  options.output.world_frame = parameters_.world_frame;
  for (const mpm::CommandDefinition& commanded : scene_.commands) options.output.others.push_back(commanded.frame);
  options.output.force_scale = parameters_.force_scale;
  options.output.state_hash = parameters_.state_hash;
  if (!parameters_.record.empty())
    options.bag = bag_path(parameters_.record, scene_.definition.name, runs_ + 1, parameters_.record_folder);
  options.bag_options.topics_below = node_.getNamespace();
  options.bag_options.compression = parameters_.record_compression;
  constexpr double kMegabyte = 1e6;
  options.bag_options.split_size =
      static_cast<std::uint64_t>(std::min(parameters_.record_split_size * kMegabyte, 1e15));
  options.bag_options.split_duration = std::llround(std::min(parameters_.record_split_duration, 1e9) * 1e9);
  options.bag_options.required = parameters_.record_required;
  options.parameters = parameters_.text;
  return options;
}

Stamps SimulatorNode::first_stamps() const {
  if (ros::Time::isSimTime()) return Stamps();
  const ros::WallTime now = ros::WallTime::now();
  return Stamps(ros::Time(now.sec, now.nsec));
}

void SimulatorNode::start_run(const Stamps& stamps, const std::string& resume) {
  RunOptions options = run_options();
  CommandQueue queue(queue_->sync_period());
  CommandWatch watch(std::llround(parameters_.command_timeout * 1e9));
  auto limiter = std::make_unique<CommandLimiter>(*limiter_);
  limiter->clear();
  if (!resume.empty()) {
    resume_from(resume, options);
    options.more = [&](mpm::StateArchive& archive) { keep(archive, queue, watch, *limiter); };
  }
  auto run = std::make_unique<Run>(scene_, options, stamps, publishers_.get());
  if (run_) end_run();
  run_ = std::move(run);
  ++runs_;  // names the next bag
  record_lost_ = false;
  if (const BagRecorder* recorder = run_->recorder()) {
    ROS_INFO_STREAM("recording to " << recorder->path() << (recorder->replaced() ? ", which is replaced" : ""));
  }
  // First: what is being read by the old stamps then comes before it, and goes.
  if (bridge_) bridge_->reader().set_stamps(run_->stamps());
  queue_->take_over(queue);
  log_.skip_to(run_->simulation().time());
  watch_ = watch;
  limiter_ = std::move(limiter);
  if (bridge_) bridge_->follower().clear();
  health_.restart();
  failure_.clear();
  clock_.restart();
}

SimulatorNode::Phase SimulatorNode::phase() const {
  if (!failure_.empty()) return Phase::failed;
  if (run_->ended()) return Phase::ended;
  if (paused_) return Phase::paused;
  return parameters_.pacing == Pacing::lockstep ? Phase::waiting : Phase::running;
}

void SimulatorNode::begin_run() {
  tell_clock(true);
  count_commands();  // those of an earlier run stay in the count
  try {
    run_->begin();
  } catch (const BagError& error) {
    fail(error.what(), 1);
  }
  pacer_->restart(Pacer::Clock::now());
  report();
}

int SimulatorNode::spin() {
  begin_run();
  while (!stop_requested_()) {
    const Phase now = phase();
    if (now == Phase::failed || (now == Phase::ended && !parameters_.keep_alive)) break;
    if (now != Phase::running) {
      mailbox_.run_until(Pacer::Clock::now() + kGlance);
      continue;
    }
    mailbox_.run_until(Pacer::Clock::now());
    if (phase() != Phase::running || !sync_period({}) || parameters_.pacing != Pacing::real_time) continue;
    const Pacer::Clock::time_point due = pacer_->next(Pacer::Clock::now());
    while (Pacer::Clock::now() < due && phase() == Phase::running && !stop_requested_()) {
      mailbox_.run_until(std::min(due, Pacer::Clock::now() + kGlance));
    }
  }
  end_run();
  mailbox_.close();
  std::this_thread::sleep_for(kLinger);
  return exit_code_;
}

bool SimulatorNode::sync_period(const std::vector<AppliedCommand>& extra) {
  try {
    apply_due(extra);
    if (!failure_.empty() || !refusal_.empty()) return false;
    count_commands();
    run_->advance();
    tell_clock(run_->ended());
    if (run_->ended()) end_run();
    report();
    return true;
  } catch (const mpm::PhysicsError& error) {
    fail(error.what(), 3);
  } catch (const mpm::Error& error) {
    fail(error.what(), 2);
  } catch (const ParameterError& error) {
    fail(error.what(), 2);
  } catch (const BagError& error) {
    fail(error.what(), 1);
  }
  return false;
}

void SimulatorNode::fail(const std::string& reason, int exit_code) {
  failure_ = reason;
  exit_code_ = exit_code;
  ROS_FATAL_STREAM(reason);
  try {
    count_commands();
    run_->fail(reason);
    say_closed();
  } catch (const BagError& error) {
    ROS_FATAL_STREAM(error.what());
  }
  leave_failed_state();
  report();
}

void SimulatorNode::say_closed() const {
  const BagRecorder* recorder = run_->recorder();
  if (recorder != nullptr && recorder->failure().empty()) ROS_INFO_STREAM("the bag is closed: " << run_->bag());
}

void SimulatorNode::end_run() {
  if (run_->closed()) return;
  try {
    count_commands();
    run_->finish();
    say_closed();
  } catch (const BagError& error) {
    ROS_FATAL_STREAM(error.what());
    exit_code_ = 1;
  }
}

void SimulatorNode::count_commands() {
  const LateCommands late = queue_->late();
  run_->count_commands(late.unstamped + late.past, health_.refused());
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
  solver.time = static_cast<double>(run_->simulation().time()) * 1e-9;
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
  solver.particles = state.particles;
  solver.returned = state.particles_returned;
  health_.set_solver(solver);

  const LateCommands late = queue_->late();
  health_.set_commands({late.unstamped, late.past, queue_->waiting()});
}

void SimulatorNode::housekeeping() {
  // Once a second, and at once when there is news. Runs on the steady clock: simulated time may stand still.
  const std::unique_lock<std::mutex> lock(housekeeping_, std::try_to_lock);
  if (!lock) return;
  const auto now = std::chrono::steady_clock::now();
  const bool due = now - checked_at_ >= std::chrono::seconds(1);
  if (due) {
    checked_at_ = now;
    if (bridge_) bridge_->find_strangers();
  }
  if (health_.take_news() || due) diagnostics_->force_update();
}

}  // namespace mpm_ros
