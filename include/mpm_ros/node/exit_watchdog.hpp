// Ends the process where it does not hear a stop itself: while roscpp waits, without a limit, for a master that is gone
// or hangs, and while a scene is read and built.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>

namespace mpm_ros {

class ExitWatchdog {
 public:
  static constexpr std::chrono::milliseconds kPatience{900};

  /// Watches from here on, in a thread that lasts as long as the process, and so must this. A stop (stop_signals.hpp)
  /// ends the process after 0.9 s, with exit code 0, until must_finish().
  /// `patience`: with what roscpp does at the end of a node that nobody stopped.
  explicit ExitWatchdog(std::chrono::milliseconds patience = std::chrono::seconds(5));

  /// There is a record, which has to be closed first: a stop alone ends nothing.
  void must_finish() { may_end_ = false; }
  /// The record is closed, and the node ends: the process ends with this exit code, whatever roscpp waits for.
  void ends(int exit_code);

  /// While one exists, its thread may be deaf to a stop for long, as when a scene is built beside a run whose record is
  /// open. A stop then ends the process after 0.9 s all the same: `close`, called by the watchdog's thread, closes the
  /// record, and returns the exit code. The thread that made it does not come past its end any more. `patience`: in
  /// place of the 0.9 s.
  class Deaf {
   public:
    Deaf(ExitWatchdog& watchdog, std::function<int()> close, std::chrono::milliseconds patience = kPatience);
    ~Deaf();
    Deaf(const Deaf&) = delete;
    Deaf& operator=(const Deaf&) = delete;

   private:
    ExitWatchdog& watchdog_;
  };

 private:
  [[noreturn]] void watch();

  const std::chrono::milliseconds patience_;
  std::atomic<int> exit_code_{0};
  std::atomic<bool> may_end_{true};
  std::atomic<bool> ends_{false};
  std::mutex mutex_;  ///< mutex of close_
  std::function<int()> close_;
  std::chrono::milliseconds close_after_{kPatience};  ///< the same mutex
};

}  // namespace mpm_ros
