#include "mpm_ros/run/run_scene_progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mpm_ros {

std::string clock_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::llround(std::max(0.0, seconds)));
  const std::int64_t hours = whole / 3600, minutes = whole / 60 % 60, rest = whole % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, rest) : fmt::format("{}:{:02}", minutes, rest);
}

ProgressBar::ProgressBar(std::ostream& out, std::int64_t end, bool enabled) : out_(out), end_(end), enabled_(enabled) {}

void ProgressBar::show(std::int64_t time) {
  const Clock::time_point now = Clock::now();
  if (!enabled_ || now - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = now;
  constexpr int kWidth = 40;
  const double part = std::min(1.0, static_cast<double>(time) / static_cast<double>(end_));
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const auto full = static_cast<std::size_t>(part * kWidth);
  const std::string left = part > 0.0 ? clock_text(elapsed * (1.0 - part) / part) + " left" : "";
  // Erases to the end of the line, for a shorter text over a longer one.
  out_ << fmt::format("\r[{:<{}}] {:3.0f} %  t = {:.4g} of {:.4g} s  {}\x1b[K", std::string(full, '='), kWidth,
                      100.0 * part, static_cast<double>(time) / 1e9, static_cast<double>(end_) / 1e9, left)
       << std::flush;
}

void ProgressBar::clear() {
  if (enabled_ && drawn_ != Clock::time_point{}) out_ << "\r\x1b[K" << std::flush;
}

}  // namespace mpm_ros
