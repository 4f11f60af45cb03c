// What happens to commands at a sync point: those that are due, those of limited bodies under way, and silence.
#include <fmt/format.h>

#include "mpm_ros/node/simulator_node.hpp"

namespace mpm_ros {

namespace {

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

}  // namespace

void SimulatorNode::apply_due(const std::vector<AppliedCommand>& extra) {
  if (!log_.empty()) {
    try {
      for (const AppliedCommand& command : log_.take(run_->simulation())) apply(command);
    } catch (const BagError& error) {
      throw ParameterError(fmt::format("parameter ~commands, {}: {}", parameters_.commands, error.what()));
    }
    return;
  }
  const std::int64_t now = run_->simulation().time();
  bridge_->follower().look(run_->stamps().at(now + run_->simulation().sync_period()));
  for (const DueCommand& due : queue_->take(now)) apply(in_world(due, run_->simulation().bodies(), now));
  for (const AppliedCommand& command : extra) {
    refusal_ = apply(command);
    if (!refusal_.empty()) return;
  }
  act_on_silence();
  apply_limited();
}

void SimulatorNode::apply_limited() {
  for (const AppliedCommand& command : limiter_->next(run_->simulation())) {
    try {
      run_->apply(command);
    } catch (const mpm::RigidError& error) {
      limiter_->drop(command.body);
      health_.refuse(fmt::format("a command for '{}': {}", bodies_[command.body], error.what()));
    }
  }
}

std::string SimulatorNode::apply(const AppliedCommand& command) {
  const mpm::RigidBody& body = run_->simulation().rigid_body(command.body);
  const mpm::Drive before = body.drive();
  mpm::Drive after = static_cast<mpm::Drive>(command.kind);
  try {
    if (!limiter_->take(command, run_->simulation())) {
      const std::string jump = jump_of(command, run_->simulation());
      run_->apply(command);
      after = body.drive();
      if (!jump.empty()) health_.jump(jump);
    }
  } catch (const mpm::RigidError& error) {
    const std::string reason = fmt::format("a command for '{}': {}", body.name(), error.what());
    health_.refuse(reason);
    return reason;
  }
  watch_.heard(command);
  health_.follow(follower_name(body.name(), command.kind == CommandKind::wrench),
                 static_cast<double>(command.effect) * 1e-9);
  if (after != before) {
    health_.change(fmt::format("{} follows {} from {:.6f} s on, no longer {}", body.name(), drive_text(after),
                               static_cast<double>(command.effect) * 1e-9, drive_text(before)));
  }
  return {};
}

void SimulatorNode::act_on_silence() {
  const std::int64_t now = run_->simulation().time();
  for (const Silence& silent : watch_.silent(now)) {
    const std::string follower = follower_name(bodies_[silent.body], silent.wrench);
    const std::string silence =
        fmt::format("no {} for '{}' in the {:g} s (simulated) before {:.6f} s", silent.wrench ? "wrench" : "command",
                    bodies_[silent.body], parameters_.command_timeout, static_cast<double>(now) * 1e-9);
    if (parameters_.on_timeout == OnTimeout::error) {
      fail(silence + "; ~on_timeout is error", 3);
      return;
    }
    if (parameters_.on_timeout == OnTimeout::stop) {
      for (const AppliedCommand& stop : stop_commands(silent.body, run_->simulation())) {
        if ((stop.kind == CommandKind::wrench) != silent.wrench) continue;
        if (!limiter_->take(stop, run_->simulation())) run_->apply(stop);
      }
      health_.time_out(follower, silence + (silent.wrench ? ": nothing pushes it any more" : ": it stands still"));
    } else {
      health_.time_out(follower, silence + ": it goes on as it was told last");
    }
  }
}

}  // namespace mpm_ros
