#include "mpm_ros/message/node_health.hpp"

#include <ros/console.h>

#include <utility>

namespace mpm_ros {

namespace {

constexpr std::chrono::seconds kQuiet{1};
constexpr std::size_t kMostLines = 1000;  // distinct lines remembered

}  // namespace

void NodeHealth::refuse(const std::string& reason) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++refused_;
  last_problem_ = "refused: " + reason;
  news_ = true;
  const auto now = std::chrono::steady_clock::now();
  if (logged_.size() > kMostLines) logged_.clear();
  const auto [entry, fresh] = logged_.emplace(reason, now);
  if (!fresh && now - entry->second < kQuiet) return;
  entry->second = now;
  ROS_WARN_STREAM("refused: " << reason);
}

void NodeHealth::change(const std::string& what) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++changes_;
  last_change_ = what;
  news_ = true;
  ROS_INFO_STREAM(what);
}

void NodeHealth::time_out(const std::string& what) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++timeouts_;
  last_problem_ = what;
  news_ = true;
  ROS_WARN_STREAM(what);
}

void NodeHealth::set_solver(const SolverHealth& solver) {
  const std::lock_guard<std::mutex> lock(mutex_);
  news_ = news_ || solver.phase != solver_.phase;
  solver_ = solver;
}

void NodeHealth::fill_commands(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (last_problem_.empty()) {
    status.summary(diagnostic_msgs::DiagnosticStatus::OK, "commands are applied as they come");
  } else {
    status.summary(diagnostic_msgs::DiagnosticStatus::WARN, last_problem_);
  }
  status.add("refused", refused_);
  status.add("late (zero or past stamp)", solver_.late);
  status.add("waiting", solver_.waiting);
  status.add("timeouts", timeouts_);
  status.add("changes of kind", changes_);
  status.add("last change", last_change_);
}

void NodeHealth::fill_solver(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  status.summary(solver_.failed ? diagnostic_msgs::DiagnosticStatus::ERROR : diagnostic_msgs::DiagnosticStatus::OK,
                 solver_.phase);
  status.add("simulated time [s]", solver_.time);
  status.add("real-time factor", solver_.real_time_factor);
  status.add("overruns", solver_.overruns);
}

bool NodeHealth::take_news() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(news_, false);
}

}  // namespace mpm_ros
