// The services of the node: pause, reset, step.
#include <fmt/format.h>
#include <ros/console.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "mpm_ros/message/contact_average.hpp"
#include "mpm_ros/node/simulator_node.hpp"

namespace mpm_ros {

namespace {

constexpr const char* kEnding = "the node is ending";
/// How long a step waits for command messages that are on their way, by the wall's clock.
constexpr std::chrono::milliseconds kPatience{5000};
/// [s] of simulated time; its nanoseconds are still a whole number of 64 bits.
constexpr double kLongestStep = 1e9;
/// How often it looks whether the node is to stop.
constexpr std::chrono::milliseconds kPoll{50};

}  // namespace

bool SimulatorNode::on_pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  response.message = kEnding;
  mailbox_.call([&] { pause(request.data != 0, response); });
  return true;
}

bool SimulatorNode::on_reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  response.message = kEnding;
  mailbox_.call([&] { reset(response); });
  return true;
}

bool SimulatorNode::on_step(Step::Request& request, Step::Response& response) {
  response.message = kEnding;
  if (!wait_received(request, response)) return true;
  mailbox_.call([&] { step(request, response); });
  return true;
}

void SimulatorNode::pause(bool paused, std_srvs::SetBool::Response& response) {
  paused_ = paused;
  run_->resume_clock();
  pacer_->restart(Pacer::Clock::now());
  report();
  response.success = 1;
  response.message = fmt::format("{} at {:.6f} s (simulated)", paused ? "paused" : "not paused",
                                 static_cast<double>(run_->simulation().time()) * 1e-9);
}

void SimulatorNode::reset(std_srvs::Trigger::Response& response) {
  // Stamps never run backwards unless that was asked for: simulated time is zero again, at a stamp later than all
  // before.
  ros::Time origin;
  if (parameters_.reset_time == ResetTime::resume) {
    const std::int64_t next = run_->simulation().time() + run_->simulation().sync_period();
    origin = run_->stamps().at(next);
    if (!ros::Time::isSimTime()) origin = std::max(origin, first_stamps().origin());
  }
  try {
    start_run(Stamps(origin));
  } catch (const std::exception& error) {
    // A bag that cannot be opened, or memory: the run goes on as it was.
    response.success = 0;
    response.message = error.what();
    return;
  }
  if (parameters_.reset_time == ResetTime::zero) commands_.forget_frames();
  begin_run();
  response.success = failure_.empty() ? 1 : 0;
  response.message = failure_.empty() ? fmt::format("run {}: simulated time is zero again, at stamp {}.{:09d}", runs_,
                                                    origin.sec, origin.nsec)
                                      : failure_;
}

bool SimulatorNode::wait_received(const Step::Request& request, Step::Response& response) const {
  if (request.after_received == 0) return true;
  response.success = 0;
  if (commands_.replays()) {
    response.message = "recorded commands are being replayed (~commands); others are not received";
    return false;
  }
  for (auto waited = std::chrono::milliseconds(0); waited < kPatience && !stop_requested_(); waited += kPoll) {
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
  const double periods = request.duration * 1e9 / static_cast<double>(run_->simulation().sync_period());
  // Rounded up, but for the round-off of a duration meant to be whole.
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(periods - 1e-6)));
}

void SimulatorNode::step(const Step::Request& request, Step::Response& response) {
  response.success = 0;
  response.message.clear();
  response.stamp = run_->outputs().stamp();
  response.time = static_cast<double>(run_->simulation().time()) * 1e-9;
  response.bodies = run_->outputs().body_states();
  response.received = commands_.received();

  std::string problem;
  const Phase now = phase();
  if (parameters_.pacing != Pacing::lockstep) {
    problem = "step needs ~pacing lockstep";
  } else if (now == Phase::paused) {
    problem = "paused; call pause with false first";
  } else if (now == Phase::ended) {
    problem = fmt::format("the run has ended at {:.6f} s; call reset to begin again", response.time);
  } else if (now == Phase::failed) {
    problem = failure_;
  }
  std::int64_t periods = 0;
  std::vector<AppliedCommand> commands;
  if (problem.empty()) periods = periods_of(request, problem);
  if (problem.empty()) commands = commands_.read(request.commands, periods, *run_, problem);
  if (!problem.empty()) {
    response.message = problem;
    if (!request.commands.empty()) health_.refuse("a step request: " + problem);
    return;
  }

  // What comes on topics from here on waits for the next step: where it took effect would depend on when it came.
  commands_.hold();
  std::string refusal;
  ContactAverage contacts;
  run_->resume_clock();
  const std::int64_t end = run_->simulation().time() + periods * run_->simulation().sync_period();
  for (std::int64_t period = 0; period < periods && !run_->ended() && !stop_requested_(); ++period) {
    if (!sync_period(period == 0 ? commands : std::vector<AppliedCommand>(), refusal)) break;
    contacts.add(run_->outputs().contacts());
  }
  commands_.release();
  response.message = failure_.empty() ? refusal : failure_;
  if (response.message.empty() && !run_->ended() && run_->simulation().time() < end) response.message = kEnding;
  response.success = response.message.empty() ? 1 : 0;
  if (response.message.empty() && run_->ended()) response.message = "the run has ended";
  response.stamp = run_->outputs().stamp();
  response.time = static_cast<double>(run_->simulation().time()) * 1e-9;
  response.contact_forces = run_->outputs().contact_forces(contacts.take());
  response.bodies = run_->outputs().body_states();
}

}  // namespace mpm_ros
