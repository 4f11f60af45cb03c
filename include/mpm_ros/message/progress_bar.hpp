// Progress of a long work, with the time left: a bar that is drawn over itself on a terminal, elsewhere (a log, a pipe)
// a line for each tenth.
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
  /// `terminal`: whether `out` can draw over a line. If not, a line is written when another tenth of the work is done,
  /// from `quiet` after the start on: a short work says nothing.
  ProgressBar(std::ostream& out, bool terminal, std::chrono::milliseconds quiet = std::chrono::seconds(5))
      : out_(out), terminal_(terminal), quiet_(quiet) {}
  /// Draws a bar at most ten times a second. `part` of the work that is done, 0 to 1; `text` says what stands beside
  /// the bar and is asked only when it is drawn.
  void show(double part, const std::function<std::string()>& text);
  /// Takes the bar off the screen; lines stay.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void write_line(double part, double elapsed, const std::function<std::string()>& text);

  std::ostream& out_;
  bool terminal_;
  std::chrono::milliseconds quiet_;
  int tenths_ = 0;  // done when the last line was written
  Clock::time_point start_ = Clock::now();
  Clock::time_point drawn_{};
};

}  // namespace mpm_ros
