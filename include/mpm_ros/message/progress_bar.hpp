// How far a long work is: a bar that is drawn over itself on a terminal, with the time left.
#pragma once

#include <chrono>
#include <functional>
#include <ostream>
#include <string>

namespace mpm_ros {

/// "0:07", "12:34", "3:02:01".
std::string clock_text(double seconds);

class ProgressBar {
 public:
  /// `enabled`: false draws nothing.
  ProgressBar(std::ostream& out, bool enabled) : out_(out), enabled_(enabled) {}
  /// Draws at most ten times a second. `part` of the work that is done, 0 to 1; `text` says what stands beside the bar
  /// and is asked only when it is drawn.
  void show(double part, const std::function<std::string()>& text);
  /// Takes the bar off the screen.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::ostream& out_;
  bool enabled_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point drawn_{};
};

}  // namespace mpm_ros
