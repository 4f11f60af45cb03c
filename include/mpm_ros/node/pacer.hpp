// Keeps simulated time at the wall clock's pace. The only part of the node that reads the wall clock.
#pragma once

#include <chrono>
#include <cstdint>

namespace mpm_ros {

class Pacer {
 public:
  using Clock = std::chrono::steady_clock;

  /// `period` [ns] simulated from one deadline to the next, `factor` simulated over wall time, > 0.
  Pacer(std::int64_t period, double factor);
  /// For a run with another period; restart() is to follow.
  void set_period(std::int64_t period) { period_ = static_cast<double>(period) / factor_; }

  /// Begins again from `now`: at the start, after a pause.
  void restart(Clock::time_point now);
  /// Time at which the sync period that is computed at `now` is due. A deadline that has passed is an overrun. A delay
  /// is caught up with evenly: two sync points are kCatchUp of a period apart at least. One of more than kLargestDebt
  /// is given up.
  Clock::time_point next(Clock::time_point now);
  /// Part of the wall time of the sync period that is about to be computed that has gone at `now`.
  Clock::duration late(Clock::time_point now) const;
  std::uint64_t overruns() const { return overruns_; }
  /// Number of times that a delay was given up.
  std::uint64_t given_up() const { return given_up_; }
  /// The delay that was given up last.
  Clock::duration last_delay() const { return last_delay_; }

  static constexpr std::chrono::milliseconds kLargestDebt{100};
  static constexpr double kCatchUp = 0.8;

 private:
  /// The one with that number since start_.
  Clock::time_point deadline(std::int64_t number) const;
  /// Time at which the sync period that began at begun_ may end at the soonest.
  Clock::time_point soonest() const;

  const double factor_;
  double period_;            // [ns] of the wall's clock
  Clock::time_point start_;  // deadlines are counted from here, so that no rounding adds up
  Clock::time_point begun_;  // start of the period that is computed now
  std::int64_t count_ = 0;   // number of deadlines since start_
  std::uint64_t overruns_ = 0, given_up_ = 0;
  Clock::duration last_delay_{};
};

}  // namespace mpm_ros
