// Work that other threads hand to the solver's thread, done there between two sync periods. Services use it, so that
// only one thread ever touches the simulation.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>

namespace mpm_ros {

class Mailbox {
 public:
  /// Turn of a piece of work when several wait; at_once: first, and work that takes long ends for it.
  enum class Turn { last, first, at_once };
  /// Hands over `work` and waits until it is done. False, with the work not done, once closed, or where the solver's
  /// thread has been busy for kBusyPatience. Not from the thread that calls run_until().
  bool call(const std::function<void()>& work, Turn turn = Turn::last);
  /// Does what has been handed over; waits for more until `deadline`, or until some work was done.
  /// What the work throws comes out here; the caller is let go.
  void run_until(std::chrono::steady_clock::time_point deadline);
  /// Lets every waiting caller go.
  void close();
  bool closed() const;
  /// The solver's thread begins, or ends, work that takes nobody knows how long: callers do not wait for its end.
  void set_busy(bool busy);
  static constexpr std::chrono::milliseconds kBusyPatience{1000};
  /// True if some work waits that others end for. Any thread; true from the moment in which run_until() would find it.
  bool urgent() const { return urgent_ > 0; }

 private:
  struct Letter {
    const std::function<void()>* work;
    Turn turn;
    bool done = false;
  };
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Letter*> letters_;
  bool closed_ = false;
  std::optional<std::chrono::steady_clock::time_point> busy_since_;
  std::atomic<int> urgent_{0};  // number of letters_ of Turn::at_once
};

}  // namespace mpm_ros
