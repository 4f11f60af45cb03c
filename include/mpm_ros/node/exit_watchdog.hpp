// Ends the process where roscpp does not: with a master that is gone, or hangs, its calls wait without a limit, and
// neither a signal nor ros::shutdown() ends them.
#pragma once

#include <atomic>
#include <chrono>

namespace mpm_ros {

class ExitWatchdog {
 public:
  /// Watches from here on, in a thread that lasts as long as the process, and so must this. A stop (stop_signals.hpp)
  /// ends the process after 0.9 s, with exit code 0, until must_finish().
  /// `patience`: with what roscpp does at the end of a node that nobody stopped.
  explicit ExitWatchdog(std::chrono::milliseconds patience = std::chrono::seconds(5));

  /// There is a record, which has to be closed first: a stop alone ends nothing.
  void must_finish() { may_end_ = false; }
  /// The record is closed, and the node ends: the process ends with this exit code, whatever roscpp waits for.
  void ends(int exit_code);

 private:
  [[noreturn]] void watch() const;

  const std::chrono::milliseconds patience_;
  std::atomic<int> exit_code_{0};
  std::atomic<bool> may_end_{true};
  std::atomic<bool> ends_{false};
};

}  // namespace mpm_ros
