// The services of the node: pause, reset, step.
#include <fmt/format.h>
#include <ros/console.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <utility>

#include "mpm_ros/command/set_state.hpp"
#include "mpm_ros/message/contact_average.hpp"
#include "mpm_ros/message/robot_messages.hpp"
#include "mpm_ros/node/simulator_node.hpp"

namespace mpm_ros {

namespace {

/// Time that a step waits for command messages that are on their way, by the wall's clock.
constexpr std::chrono::milliseconds kPatience{5000};
/// [s] of simulated time; its nanoseconds are still a whole number of 64 bits.
constexpr double kLongestStep = 1e9;
/// Number of commands of one request; each is checked, applied, published and recorded at one sync point.
constexpr std::size_t kMostCommands = 10'000;
/// Time between looks whether the node is to stop.
constexpr std::chrono::milliseconds kPoll{50};

}  // namespace

bool SimulatorNode::on_pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  const bool paused = request.data != 0;
  hand_over([&] { pause(paused, response); }, response.message, paused ? Mailbox::Turn::at_once : Mailbox::Turn::first);
  return true;
}

bool SimulatorNode::on_reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  const auto work = [&] {
    bool success = false;
    try {
      response.message = reset(poses_.any() ? load_subject(subject_->set) : subject_, success);
    } catch (const std::exception& error) {
      response.message = refusal_of(error);
    }
    response.success = success ? 1 : 0;
  };
  hand_over(work, response.message);
  return true;
}

bool SimulatorNode::on_reset_with(Reset::Request& request, Reset::Response& response) {
  hand_over([&] { reset_with(request, response); }, response.message);
  return true;
}

bool SimulatorNode::on_set_state(SetState::Request& request, SetState::Response& response) {
  hand_over([&] { set_state(request, response); }, response.status_message);
  return true;
}

bool SimulatorNode::on_step(Step::Request& request, Step::Response& response) {
  if (!wait_received(request, response)) return true;
  hand_over([&] { step(request, response); }, response.message);
  return true;
}

void SimulatorNode::pause(bool paused, std_srvs::SetBool::Response& response) {
  paused_ = paused;
  run_->resume_clock();
  pacer_->restart(Pacer::Clock::now());
  report();
  response.success = 1;
  response.message = fmt::format("{} at {:.6f} s (simulated)", paused ? "paused" : "not paused",
                                 mpm::seconds_of(run_->simulation().time()));
}

std::string SimulatorNode::refusal_of(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) == nullptr) return error.what();
  return "there is not enough memory for this; the run is as it was";
}

std::string SimulatorNode::reset(const std::shared_ptr<const Subject>& subject, bool& success) {
  success = false;
  // Stamps never run backwards unless that was asked for: simulated time is zero again, at a stamp later than all
  // before.
  ros::Time origin;
  if (parameters_.reset_time == ResetTime::resume) {
    const std::int64_t next = run_->simulation().time() + run_->simulation().sync_period();
    origin = run_->stamps().at(next);
    if (!ros::Time::isSimTime()) origin = std::max(origin, first_stamps().origin());
  }
  try {
    start_run(subject, Stamps(origin));
  } catch (const std::exception& error) {
    // A bag that cannot be opened, a scene that cannot be simulated, or memory: the run before it is as it was.
    return refusal_of(error);
  }
  if (parameters_.reset_time == ResetTime::zero) commands_.forget_frames();
  begin_run();
  success = failure_.empty();
  return success
             ? fmt::format("run {}: simulated time is zero again, at stamp {}.{:09d}", runs_, origin.sec, origin.nsec)
             : failure_;
}

void SimulatorNode::reset_with(const Reset::Request& request, Reset::Response& response) {
  bool success = false;
  try {
    std::vector<std::string> set = request.set;
    if (!request.start.empty()) {
      for (std::string& one : start_overrides(request.start, load(set), response.message)) {
        set.push_back(std::move(one));
      }
      if (!response.message.empty()) return;
    }
    response.message = reset(load_subject(set), success);
  } catch (const std::exception& error) {
    response.message = refusal_of(error);
  }
  response.success = success ? 1 : 0;
  response.run = static_cast<std::uint32_t>(runs_);
  response.received = commands_.received();
  if (!success) return;
  if (run_->recorder() != nullptr) response.bag = run_->recorder()->path();
  response.stamp = run_->outputs().stamp();
  response.contact_forces = run_->outputs().contact_forces(run_->outputs().contacts());
  response.bodies = run_->outputs().body_states();
  const std::vector<mpm::RobotReport> robots = run_->simulation().robots();
  response.robots = to_message(robots, robots, 0.0);
}

void SimulatorNode::set_state(const SetState::Request& request, SetState::Response& response) {
  response.success = 0;
  std::string& problem = response.status_message;
  switch (phase()) {
    case Phase::running:
      problem = "the run advances by itself, and states are set in a pause; call pause with true first";
      return;
    case Phase::ended:
      problem = "the run has ended; call reset or reset_with, and set the state before its first step";
      return;
    case Phase::failed:
      problem = failure_ + "; call reset or reset_with to begin again, or load_checkpoint";
      return;
    default:
      break;
  }
  const mpm::StateSet state = read_state(request, parameters_.world_frame, problem);
  if (problem.empty()) problem = commands_.set_state(*run_, state);
  if (!problem.empty()) return;
  response.success = 1;
  problem = fmt::format("'{}' is set at {:.6f} s (simulated)", state.name, mpm::seconds_of(run_->simulation().time()));
}

bool SimulatorNode::wait_received(const Step::Request& request, Step::Response& response) const {
  if (request.after_received == 0) return true;
  response.success = 0;
  if (commands_.replays()) {
    response.message = "recorded commands are being replayed (~commands); others are not received";
    return false;
  }
  for (auto waited = std::chrono::milliseconds(0); waited < kPatience && !ends(); waited += kPoll) {
    if (commands_.wait_received(request.after_received, kPoll)) return true;
  }
  response.received = commands_.received();
  response.message =
      fmt::format("waited {} s for {} messages on command topics; {} have come",
                  std::chrono::duration<double>(kPatience).count(), request.after_received, response.received);
  return false;
}

std::int64_t SimulatorNode::periods_of(const Step::Request& request, std::string& problem) const {
  if (request.count > 0) return request.count;
  if (!(request.duration >= 0.0 && request.duration <= kLongestStep)) {
    problem = fmt::format("duration is {} s; it must be at least 0 and at most {:g}", request.duration, kLongestStep);
    return 0;
  }
  const double periods =
      request.duration * mpm::kNanosecondsOfSecond / static_cast<double>(run_->simulation().sync_period());
  // Rounded up, but for the round-off of a duration meant to be whole.
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(periods - 1e-6)));
}

std::string SimulatorNode::step_refused() const {
  switch (phase()) {
    case Phase::running:
      return "the run advances by itself; call pause with true first, or start the node with ~pacing lockstep";
    case Phase::paused:
      return parameters_.pacing == Pacing::lockstep ? "paused; call pause with false first" : "";
    case Phase::ended:
      return fmt::format("the run has ended at {:.6f} s; call reset to begin again",
                         mpm::seconds_of(run_->simulation().time()));
    case Phase::failed:
      return failure_ + "; call reset or reset_with to begin again, or load_checkpoint";
    case Phase::waiting:
      break;
  }
  return {};
}

void SimulatorNode::step(const Step::Request& request, Step::Response& response) {
  response.success = 0;
  response.stamp = run_->outputs().stamp();
  response.time = mpm::seconds_of(run_->simulation().time());
  response.received = commands_.received();

  std::string problem = step_refused();
  std::int64_t periods = 0;
  StepCommands commands;
  if (problem.empty() && std::max(request.commands.size(), request.joint_commands.size()) > kMostCommands) {
    problem = fmt::format("the request has {} commands, and a step takes {} at most; send the others with later steps",
                          std::max(request.commands.size(), request.joint_commands.size()), kMostCommands);
  }
  if (problem.empty()) periods = periods_of(request, problem);
  if (problem.empty()) commands = commands_.read(request.commands, request.joint_commands, periods, *run_, problem);
  if (!problem.empty()) {
    response.message = problem;
    if (!request.commands.empty() || !request.joint_commands.empty()) health_.refuse("a step request: " + problem);
    return;
  }

  // Keeps what comes on topics from here on for the next step: its effect would depend on when it came.
  commands_.hold();
  std::string refusal;
  ContactAverage contacts;
  const std::vector<mpm::RobotReport> robots = run_->simulation().robots();
  const std::int64_t start = run_->simulation().time();
  run_->resume_clock();
  std::int64_t done = 0;
  for (; done < periods && !run_->ended() && !ends() && !mailbox_.urgent(); ++done) {
    if (!sync_period(done == 0 ? commands : StepCommands(), refusal)) break;
    contacts.add(run_->outputs().contacts());
  }
  commands_.release();
  response.stamp = run_->outputs().stamp();
  response.time = mpm::seconds_of(run_->simulation().time());
  response.message = failure_.empty() ? refusal : failure_;
  if (response.message.empty() && !run_->ended() && done < periods) {
    response.message =
        fmt::format("{} after {} of {} sync periods, at {:.6f} s",
                    ends() ? "the node is ending:" : "interrupted by pause,", done, periods, response.time);
  }
  response.success = response.message.empty() ? 1 : 0;
  if (response.message.empty() && run_->ended()) response.message = "the run has ended";
  if (done == 0 || run_->cut_short()) return;
  response.contact_forces = run_->outputs().contact_forces(contacts.take());
  response.bodies = run_->outputs().body_states();
  response.robots = to_message(run_->simulation().robots(), robots, mpm::seconds_of(run_->simulation().time() - start));
}

}  // namespace mpm_ros
