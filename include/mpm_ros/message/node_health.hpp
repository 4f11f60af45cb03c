// What went wrong or should be known, for the log and for /diagnostics: two statuses, `commands` and `solver`.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>

namespace mpm_ros {

/// How the run stands, for the status `solver`.
struct SolverHealth {
  std::string phase = "starting";  ///< "running", "paused", "waiting for step", "ended", "failed: …"
  bool failed = false;
  double time = 0.0;  ///< [s] simulated
  double real_time_factor = 0.0;
  std::uint64_t overruns = 0;  ///< sync periods that took longer than their wall time
  std::uint64_t late = 0;      ///< commands with a zero or past stamp
  std::uint64_t waiting = 0;   ///< commands whose time is to come
};

/// Safe to use from any thread.
class NodeHealth {
 public:
  /// A command was refused and changed nothing. One log line; the same line at most once a second.
  void refuse(const std::string& reason);
  /// A body follows another kind of command than before. One log line.
  void change(const std::string& what);
  /// A commanded body has not heard a command in time. One log line.
  void time_out(const std::string& what);
  void set_solver(const SolverHealth& solver);

  /// Status `commands`: warns once something was refused or timed out, with the last reason and the counts.
  void fill_commands(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  /// Status `solver`.
  void fill_solver(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  /// True once after something was reported that should be published without delay.
  bool take_news();

 private:
  mutable std::mutex mutex_;
  SolverHealth solver_;
  std::uint64_t refused_ = 0;
  std::uint64_t changes_ = 0;
  std::uint64_t timeouts_ = 0;
  std::string last_problem_;
  std::string last_change_;
  std::map<std::string, std::chrono::steady_clock::time_point> logged_;
  bool news_ = false;
};

}  // namespace mpm_ros
