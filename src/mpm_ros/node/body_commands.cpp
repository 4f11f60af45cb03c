#include "mpm_ros/node/body_commands.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace mpm_ros {

namespace {

/// [s] behind the wall clock, from which on it is said: what the pacer does not catch up with, and a half more.
constexpr double kLag = 0.15;

const char* drive_text(mpm::Drive drive) {
  switch (drive) {
    case mpm::Drive::velocity:
      return "commanded velocities";
    case mpm::Drive::pose:
      return "commanded poses";
    default:
      return "the scene's functions of time";
  }
}

/// In diagnostics: motions and wrenches of a body come from controllers of their own.
std::string follower_name(const std::string& body, bool wrench) { return wrench ? body + " (wrench)" : body; }

std::vector<mpm::MotionLimits> limits_of(const mpm::Scene& scene) {
  std::vector<mpm::MotionLimits> limits;
  for (const mpm::CommandDefinition& commanded : scene.commands) limits.push_back(commanded.limits);
  return limits;
}

}  // namespace

void CommandMemory::serialise(mpm::StateArchive& archive) {
  queue.serialise(archive);
  watch.serialise(archive);
  limiter.serialise(archive);
  turning.serialise(archive);
  const mpm::StateArchive::Group group(archive, "joints");
  joints.serialise(archive);
}

BodyCommands::BodyCommands(ros::NodeHandle node, const mpm::Scene& scene, const NodeParameters& parameters,
                           NodeHealth& health)
    : parameters_(parameters),
      health_(health),
      bodies_(mpm::commanded_names(scene)),
      log_(parameters.commands.empty() ? CommandLog() : read_commands(parameters.commands)),
      memory_(fresh_memory(scene)) {
  if (!log_.empty()) return;
  std::vector<std::string> frames;
  for (const mpm::CommandDefinition& commanded : scene.commands) frames.push_back(commanded.frame);
  node.setCallbackQueue(&callbacks_);
  const std::size_t bases = bodies_.size() - scene.definition.rigid_bodies.size();
  bridge_ = std::make_unique<CommandBridge>(node, bodies_, bases, frames, parameters.world_frame, memory_.queue,
                                            health_, parameters.tf_time == StampUse::latest,
                                            parameters.command_time == StampUse::latest);
  joint_bridge_ = std::make_unique<JointBridge>(node, scene.definition.robots, memory_.joints, health_,
                                                parameters.command_time == StampUse::latest,
                                                [this] { bridge_->reader().count_message(); });
}

void BodyCommands::listen() {
  spinner_ = std::make_unique<ros::AsyncSpinner>(1, &callbacks_);
  spinner_->start();
}

void BodyCommands::stop_listening() {
  if (spinner_) spinner_->stop();
}

CommandMemory BodyCommands::fresh_memory(const mpm::Scene& scene) const {
  // Commands that were recorded are within the limits already.
  std::vector<mpm::MotionLimits> limits = log_.empty() ? limits_of(scene) : std::vector<mpm::MotionLimits>();
  return {CommandQueue(scene.definition.time.sync),
          CommandWatch(mpm::nanoseconds_of(parameters_.command_timeout)),
          CommandLimiter(std::move(limits), health_),
          {},
          {}};
}

void BodyCommands::begin(const Run& run, const CommandMemory& memory) {
  // First: what is being read by the old stamps then comes before it, and goes.
  if (bridge_) bridge_->reader().set_stamps(run.stamps());
  if (joint_bridge_) joint_bridge_->begin(run.simulation().definition().robots, run.stamps());
  memory_.joints.take_over(memory.joints);
  memory_.queue.take_over(memory.queue);
  memory_.watch = memory.watch;
  memory_.limiter.take_over(memory.limiter);
  memory_.turning = memory.turning;
  log_.skip_to(run.simulation().time());
  if (bridge_) bridge_->follower().clear();
}

BodyCommands::Outcome BodyCommands::apply_due(Run& run, const StepCommands& extra) {
  if (replays()) {
    try {
      for (const mpm::StateSet& state : log_.take_states(run.simulation())) run.set_state(state);
      for (const AppliedCommand& command : log_.take(run.simulation())) apply(run, command);
      for (const JointOrder& order : log_.take_joints(run.simulation())) run.apply(order, true);
    } catch (const BagError& error) {
      throw ParameterError(fmt::format("parameter ~commands, {}: {}", parameters_.commands, error.what()));
    }
    return {};
  }
  const std::int64_t now = run.simulation().time();
  look_at_lag(run);
  bridge_->follower().look(run.stamps().at(now + run.simulation().sync_period()));
  for (const DueCommand& due : memory_.queue.take(now)) apply(run, in_world(due, run.simulation().commanded(), now));
  for (const JointOrder& order : memory_.joints.take(now)) apply(run, order);
  for (const AppliedCommand& command : extra.bodies) {
    if (const std::string refusal = apply(run, command); !refusal.empty()) return {refusal, {}};
  }
  for (const JointOrder& order : extra.joints) {
    if (const std::string refusal = apply(run, order); !refusal.empty()) return {refusal, {}};
  }
  if (const std::string silence = act_on_silence(run); !silence.empty()) return {{}, silence};
  turn(run);
  apply_limited(run);
  return {};
}

// Without /use_sim_time stamps are those of the wall clock, which a run that is slower, was paused or is stepped falls
// behind: what is stamped by it waits longer and longer for its time.
void BodyCommands::look_at_lag(const Run& run) {
  if (ros::Time::isSimTime()) return;
  const std::int64_t now = run.simulation().time();
  const double lag = ros::WallTime::now().toSec() - run.stamps().at(now).toSec();
  if (!(lag > kLag)) {
    health_.lag({});
    return;
  }
  const auto [frame_ahead, frame] = bridge_->follower().farthest_ahead(run.stamps().at(now));
  const CommandReader::Newest newest = bridge_->reader().newest();
  const double command_ahead = mpm::seconds_of(newest.stamp - now);
  // Commands stamped at present are ahead by the lag; a plan may be by anything.
  const bool frames_wait = frame_ahead > 0.5 * lag;
  if (!frames_wait && !(command_ahead > 0.5 * lag)) {
    health_.lag({});
    return;
  }
  const std::string pace = parameters_.pacing == Pacing::lockstep
                               ? "it is stepped"
                               : fmt::format("it advances at {:.2g} of the clock's pace", run.real_time_factor());
  const std::string what = frames_wait ? fmt::format("the tf frame '{}'", frame)
                                       : fmt::format("the commands for '{}'", bodies_[newest.body]);
  health_.lag(fmt::format(
      "the simulation is {:.2f} s behind the wall clock ({}), by which {} {} stamped: its body lags as much. Set "
      "/use_sim_time to true before any node starts, so that all follow the simulation's clock; or take the newest, "
      "whatever its stamp, with _{}:=latest; or make the run faster, with a larger grid.cell or more threads",
      lag, pace, what, frames_wait ? "is" : "are", frames_wait ? "tf_time" : "command_time"));
}

void BodyCommands::turn(Run& run) {
  for (const AppliedCommand& command : memory_.turning.next(run.simulation().commanded(), run.simulation().time())) {
    try {
      if (!memory_.limiter.take(command, run.simulation())) run.apply(command);
    } catch (const mpm::RigidError& error) {
      memory_.turning.drop(command.body);
      health_.refuse(fmt::format("the velocity of '{}' in its own axes: {}", bodies_[command.body], error.what()));
    }
  }
}

void BodyCommands::apply_limited(Run& run) {
  for (const AppliedCommand& command : memory_.limiter.next(run.simulation())) {
    try {
      run.apply(command);
    } catch (const mpm::RigidError& error) {
      memory_.limiter.drop(command.body);
      health_.refuse(fmt::format("a command for '{}': {}", bodies_[command.body], error.what()));
    }
  }
}

/// Reason why it was refused, or empty.
std::string BodyCommands::apply(Run& run, const AppliedCommand& command) {
  const mpm::RigidBody& body = run.simulation().rigid_body(command.body);
  const mpm::Drive before = body.drive();
  mpm::Drive after = static_cast<mpm::Drive>(command.kind);
  try {
    if (!memory_.limiter.take(command, run.simulation())) {
      const std::string jump = jump_of(command, run.simulation());
      run.apply(command);
      after = body.drive();
      if (!jump.empty()) health_.jump(jump);
    }
  } catch (const mpm::RigidError& error) {
    const std::string reason = fmt::format("a command for '{}': {}", body.name(), error.what());
    health_.refuse(reason);
    return reason;
  }
  if (command.kind != CommandKind::wrench) memory_.turning.drop(command.body);
  if (command.own) memory_.turning.hold(command.body, *command.own, body.pose().orientation);
  memory_.watch.heard(command);
  health_.follow(follower_name(body.name(), command.kind == CommandKind::wrench), mpm::seconds_of(command.effect));
  if (after != before) {
    health_.change(fmt::format("{} follows {} from {:.6f} s on, no longer {}", body.name(), drive_text(after),
                               mpm::seconds_of(command.effect), drive_text(before)));
  }
  return {};
}

std::string BodyCommands::apply(Run& run, const JointOrder& order) {
  try {
    run.apply(order);
  } catch (const mpm::RigidError& error) {
    const std::string reason = fmt::format("a command of joints: {}", error.what());
    health_.refuse(reason);
    return reason;
  }
  return {};
}

/// Reason why the run ends, or empty.
std::string BodyCommands::act_on_silence(Run& run) {
  const std::int64_t now = run.simulation().time();
  for (const Silence& silent : memory_.watch.silent(now)) {
    const std::string follower = follower_name(bodies_[silent.body], silent.wrench);
    const std::string silence =
        fmt::format("no {} for '{}' in the {:g} s (simulated) before {:.6f} s", silent.wrench ? "wrench" : "command",
                    bodies_[silent.body], parameters_.command_timeout, mpm::seconds_of(now));
    if (parameters_.on_timeout == OnTimeout::error) {
      return silence + "; ~on_timeout is error";
    }
    if (parameters_.on_timeout == OnTimeout::stop) {
      for (const AppliedCommand& stop : stop_commands(silent.body, run.simulation())) {
        if ((stop.kind == CommandKind::wrench) != silent.wrench) continue;
        if (!silent.wrench) memory_.turning.drop(silent.body);
        if (!memory_.limiter.take(stop, run.simulation())) run.apply(stop);
      }
      health_.time_out(follower, silence + (silent.wrench ? ": nothing pushes it any more" : ": it stands still"));
    } else {
      health_.time_out(follower, silence + ": it continues with its last command");
    }
  }
  return {};
}

StepCommands BodyCommands::read(const std::vector<Command>& requested, const std::vector<JointCommand>& joints,
                                std::int64_t periods, const Run& run, std::string& problem) const {
  StepCommands commands;
  if ((!requested.empty() || !joints.empty()) && replays()) {
    problem = "recorded commands are being replayed (~commands); others are not taken";
    return commands;
  }
  const std::int64_t now = run.simulation().time();
  const std::int64_t sync = run.simulation().sync_period();
  for (const mpm_ros::Command& message : requested) {
    DueCommand due;
    due.command = bridge_->reader().read(message, problem);
    if (!problem.empty()) return commands;
    if (due.command.kind == CommandKind::pose) {
      const std::int64_t arrival = due.command.stamp.value_or(now + periods * sync);
      if (arrival <= now) {
        problem = fmt::format("the command for '{}': its arrival is not after the present, {:.9f} s", message.body,
                              mpm::seconds_of(now));
        return commands;
      }
      due.arrival = (arrival + sync - 1) / sync * sync;
    }
    commands.bodies.push_back(in_world(due, run.simulation().commanded(), now));
    commands.bodies.back().stamp_ignored = false;  // a request has no stamp; `requested` is what it was copied with
  }
  for (const mpm_ros::JointCommand& message : joints) {
    JointOrder order = joint_bridge_->read(message, problem);
    if (!problem.empty()) return commands;
    // Without an arrival rigid drives take the whole step.
    if (order.arrival == 0) order.arrival = now + periods * sync;
    if (order.arrival <= now) {
      problem = fmt::format("the command for '{}': its arrival is not after the present, {:.9f} s", message.robot,
                            mpm::seconds_of(now));
      return commands;
    }
    commands.joints.push_back(std::move(order));
  }
  return commands;
}

bool BodyCommands::wait_received(std::uint64_t count, std::chrono::milliseconds patience) const {
  return bridge_->reader().wait_received(count, patience);
}

std::string BodyCommands::set_state(Run& run, const mpm::StateSet& state) {
  if (replays()) return "recorded commands are being replayed (~commands); nothing else is set";
  const int body = run.simulation().find_commanded(state.name);
  if (state.pose && body >= 0) {
    if (const std::string reason = bridge_->reader().refusal_of(body); !reason.empty()) {
      return fmt::format("'{}': {}", state.name, reason);
    }
  }
  try {
    run.set_state(state);
  } catch (const mpm::RigidError& error) {
    return error.what();
  }
  if (body < 0) return {};
  // It is on its way to nowhere.
  memory_.limiter.drop(body);
  memory_.turning.drop(body);
  return {};
}

void BodyCommands::forget_frames() {
  if (bridge_) bridge_->forget_frames();
}

void BodyCommands::keep_house() {
  if (!bridge_) return;
  bridge_->find_dropped();
  bridge_->find_strangers();
}

}  // namespace mpm_ros
