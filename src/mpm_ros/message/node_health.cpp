#include "mpm_ros/message/node_health.hpp"

#include <fmt/format.h>
#include <ros/console.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "mpm/implicit/sweep_budget.hpp"
#include "mpm_ros/message/audit_limit.hpp"

namespace mpm_ros {

namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr std::chrono::seconds kQuiet{1};
constexpr int kLinesInQuiet = 20;         // refusals logged in that time
constexpr std::size_t kMostLines = 1000;  // distinct lines remembered
constexpr std::size_t kLongestLine = 600;

/// Makes one line of plain text of what others wrote (names of frames and bodies), to be quoted in reasons.
std::string one_line(std::string text) {
  if (text.size() > kLongestLine) text = text.substr(0, kLongestLine) + "...";
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c > 0x7e; }, '?');
  return text;
}

std::string share_text(const std::string& frame, const std::string& node) {
  return fmt::format(
      "the node {} publishes the tf frame '{}' too, which this one publishes for its body of that name, and who looks "
      "it "
      "up gets now one, now the other: give the bodies other names, or one of the nodes a tf of its own (/tf:=/tf_2)",
      node, frame);
}

/// Messages that came and had no effect, since more came than could be kept.
std::string drop_text(const CommandHealth& commands) {
  return fmt::format(
      "{} commands and {} messages of tf have been dropped, since they came faster than they were taken; send less "
      "often",
      commands.dropped, commands.transforms_dropped);
}

}  // namespace

void NodeHealth::refuse(const std::string& reason) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::string line = one_line("refused: " + reason);
  ++refused_;
  last_refusal_ = line;
  refused_at_ = Clock::now();
  news_ = true;
  log_refusal(line, refused_at_);
}

void NodeHealth::log_refusal(const std::string& line, Clock::time_point now) {
  if (logged_.size() > kMostLines) logged_.clear();
  const auto [entry, fresh] = logged_.emplace(line, now);
  if (!fresh && now - entry->second < kQuiet) return;
  entry->second = now;
  if (now - quota_from_ >= kQuiet) {
    if (unlogged_ > 0) ROS_WARN_STREAM("refused: " << unlogged_ << " more lines, not shown");
    quota_from_ = now;
    quota_used_ = 0;
    unlogged_ = 0;
  }
  if (quota_used_ >= kLinesInQuiet) {
    ++unlogged_;
    return;
  }
  ++quota_used_;
  ROS_WARN_STREAM(line);
}

void NodeHealth::follow(const std::string& body, double time) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Follower& follower = followers_[body];
  ++follower.commands;
  follower.last = time;
  follower.silent = false;
}

void NodeHealth::change(const std::string& what) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++changes_;
  last_change_ = one_line(what);
  news_ = true;
  ROS_INFO_STREAM(last_change_);
}

void NodeHealth::time_out(const std::string& body, const std::string& what) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++timeouts_;
  followers_[body].silent = true;
  last_timeout_ = one_line(what);
  news_ = true;
  ROS_WARN_STREAM(last_timeout_);
}

void NodeHealth::wait(const std::string& body, const std::string& what) {
  const std::lock_guard<std::mutex> lock(mutex_);
  followers_[body].waits = one_line(what);
  news_ = true;
  if (!what.empty()) ROS_WARN_STREAM(followers_[body].waits);
}

void NodeHealth::jump(const std::string& what) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++jumps_;
  last_jump_ = one_line(what);
  jumped_at_ = Clock::now();
  news_ = true;
  log_refusal(last_jump_, jumped_at_);
}

void NodeHealth::lag(const std::string& what) {
  const std::lock_guard<std::mutex> lock(mutex_);
  news_ = news_ || what.empty() != lag_.empty();
  const Clock::time_point now = Clock::now();
  if (!what.empty() && (lag_.empty() || now - lag_logged_ >= kFresh)) {
    lag_logged_ = now;
    ROS_WARN_STREAM(one_line(what));
  }
  lag_ = one_line(what);
}

void NodeHealth::share_frame(const std::string& frame, const std::string& node) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string& told = shared_frames_[frame];
  if (told == node) return;
  told = node;
  news_ = true;
  ROS_WARN_STREAM(one_line(share_text(frame, node)));
}

void NodeHealth::limit(const std::string& body, const LimitHealth& limits) {
  const std::lock_guard<std::mutex> lock(mutex_);
  LimitHealth& before = followers_[body].limits;
  if (before.limited == 0 && limits.limited > 0) {
    ROS_INFO_STREAM("'" << body << "' is kept within its limits; /diagnostics counts its commands that are");
  }
  news_ = news_ || (before.behind > 0.0) != (limits.behind > 0.0);
  before = limits;
}

void NodeHealth::set_solver(const SolverHealth& solver) {
  const std::lock_guard<std::mutex> lock(mutex_);
  news_ = news_ || solver.phase != solver_.phase;
  solver_ = solver;
  if (!(solver.cut_error > mpm::kForceErrorBound)) return;
  const Clock::time_point now = Clock::now();
  const bool fresh = worst_cut_ > 0.0 && now - worst_cut_at_ < kFresh;
  news_ = news_ || !fresh;
  if (fresh && solver.cut_error < worst_cut_) return;
  worst_cut_ = solver.cut_error;
  worst_cut_at_ = now;
}

void NodeHealth::set_commands(const CommandHealth& commands) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool more = commands.dropped > commands_.dropped || commands.transforms_dropped > commands_.transforms_dropped;
  commands_ = commands;
  if (!more) return;
  dropped_at_ = Clock::now();
  news_ = true;
  if (dropped_at_ - drop_logged_ < kFresh) return;
  drop_logged_ = dropped_at_;
  ROS_WARN_STREAM(drop_text(commands_));
}

void NodeHealth::restart() {
  const std::lock_guard<std::mutex> lock(mutex_);
  followers_.clear();
  lag_.clear();
  worst_cut_ = 0.0;
}

std::uint64_t NodeHealth::refused() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return refused_;
}

void NodeHealth::fill_commands(diagnostic_updater::DiagnosticStatusWrapper& status, Clock::time_point now) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  status.summary(DiagnosticStatus::OK, "commands are applied as they come");
  const bool silent =
      std::any_of(followers_.begin(), followers_.end(), [](const auto& follower) { return follower.second.silent; });
  if (silent) status.mergeSummary(DiagnosticStatus::WARN, last_timeout_);
  if (!shared_frames_.empty()) {
    const auto& [frame, node] = *shared_frames_.begin();
    status.mergeSummary(DiagnosticStatus::WARN, one_line(share_text(frame, node)));
  }
  if (!lag_.empty()) status.mergeSummary(DiagnosticStatus::WARN, lag_);
  for (const auto& [body, follower] : followers_) {
    if (!follower.waits.empty()) status.mergeSummary(DiagnosticStatus::WARN, follower.waits);
    const LimitHealth& limits = follower.limits;
    if (limits.behind > 0.0 || limits.behind_angle > 0.0) {
      status.mergeSummary(DiagnosticStatus::WARN, fmt::format("'{}' is behind its pose by {:.3g} m and {:.3g} rad, as "
                                                              "its limits have it",
                                                              body, limits.behind, limits.behind_angle));
    }
  }
  if (commands_.dropped + commands_.transforms_dropped > 0 && now - dropped_at_ < kFresh)
    status.mergeSummary(DiagnosticStatus::WARN, drop_text(commands_));
  if (jumps_ > 0 && now - jumped_at_ < kFresh) status.mergeSummary(DiagnosticStatus::WARN, last_jump_);
  if (refused_ > 0 && now - refused_at_ < kFresh) status.mergeSummary(DiagnosticStatus::WARN, last_refusal_);
  status.add("refused", refused_);
  status.add("last refused", last_refusal_);
  status.add("late: stamp zero", commands_.unstamped);
  status.add("late: stamp past", commands_.past);
  status.add("waiting", commands_.waiting);
  status.add("waiting at most", commands_.most_waiting);
  status.add("farthest stamp ahead [s]", commands_.horizon);
  status.add("dropped", commands_.dropped);
  status.add("dropped messages of tf", commands_.transforms_dropped);
  status.add("gaps in header.seq", commands_.missing);
  status.add("timeouts", timeouts_);
  status.add("last timeout", last_timeout_);
  status.add("jumps", jumps_);
  status.add("last jump", last_jump_);
  status.add("changes of kind", changes_);
  status.add("last change", last_change_);
  for (const auto& [body, follower] : followers_) {
    status.add("applied to " + body, fmt::format("{}, the last at {:.6f} s", follower.commands, follower.last));
    if (follower.limits.limited > 0) {
      status.add("limited of " + body, follower.limits.limited);
      status.add("behind [m] of " + body, follower.limits.behind);
      status.add("behind [rad] of " + body, follower.limits.behind_angle);
    }
  }
}

void NodeHealth::fill_solver(diagnostic_updater::DiagnosticStatusWrapper& status, Clock::time_point now) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string text = solver_.phase;
  bool warn = false;
  const auto add_warning = [&](const std::string& warning) {
    text += "; " + warning;
    warn = true;
  };
  // Written so that what is not a number warns.
  if (!(solver_.momentum_error <= audit_limit(solver_.precision))) {
    add_warning(fmt::format("the momentum audit is off by {:.2g} of the momentum exchanged", solver_.momentum_error));
  }
  if (!(solver_.courant <= 1.0)) {
    add_warning(fmt::format(
        "since the start a wave has crossed {:.2g} cells in a step, which may be unstable: lower time.sync or time.cfl",
        solver_.courant));
  }
  if (!(solver_.min_j >= kCrushed)) {
    add_warning(fmt::format("a particle is crushed to {:.3g} of its volume", solver_.min_j));
  }
  if (solver_.returned > 0) {
    add_warning(fmt::format("{} particle{} left the grid and {} put back", solver_.returned,
                            solver_.returned == 1 ? "" : "s", solver_.returned == 1 ? "was" : "were"));
  }
  if (solver_.overruns > 0 && solver_.real_time_factor < kPaceKept * solver_.asked_factor) {
    add_warning(fmt::format("slower than asked: {:.3g} of the wall clock's pace, not {:g}", solver_.real_time_factor,
                            solver_.asked_factor));
  }
  if (!solver_.short_budget.empty()) add_warning(solver_.short_budget);
  if (worst_cut_ > 0.0 && now - worst_cut_at_ < kFresh) {
    add_warning(
        fmt::format("time.budget has ended sweeps where the force on tools was off by {:.0f} %", 100.0 * worst_cut_));
  }
  if (!solver_.record_failure.empty()) text += "; not recorded any more: " + solver_.record_failure;
  const bool broken = solver_.failed || !solver_.record_failure.empty();
  const int level = broken ? DiagnosticStatus::ERROR : warn ? DiagnosticStatus::WARN : DiagnosticStatus::OK;
  status.summary(static_cast<std::uint8_t>(level), one_line(text));
  status.add("simulated time [s]", solver_.time);
  status.add("real-time factor", solver_.real_time_factor);
  status.add("overruns", solver_.overruns);
  status.add("steps", solver_.steps);
  status.add("time step [s]", solver_.step);
  status.add("time step limited by", solver_.step_limited_by);
  status.add("largest part of a cell crossed by a wave in a step", solver_.courant);
  status.add("audit: momentum error", solver_.momentum_error);
  status.add("smallest det F", solver_.min_j);
  status.add("particles", solver_.particles);
  status.add("particles returned", solver_.returned);
  // Nothing is ever outside and simulated on; the key is there for those who watch it.
  status.add("particles outside (one ends the run)", 0);
}

bool NodeHealth::take_news() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(news_, false);
}

}  // namespace mpm_ros
