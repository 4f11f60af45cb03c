// How far a run is: a bar that is drawn over itself, with the time left.
#pragma once

#include <chrono>
#include <cstdint>
#include <ostream>
#include <string>

namespace mpm_ros {

/// "0:07", "12:34", "3:02:01".
std::string clock_text(double seconds);

class ProgressBar {
 public:
  /// `end` > 0 [ns] of simulated time; `enabled`: false draws nothing.
  ProgressBar(std::ostream& out, std::int64_t end, bool enabled);
  /// Draws at most ten times a second. `time` [ns].
  void show(std::int64_t time);
  /// Takes the bar off the screen.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::ostream& out_;
  std::int64_t end_;
  bool enabled_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point drawn_{};
};

}  // namespace mpm_ros
