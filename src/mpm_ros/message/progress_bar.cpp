#include "mpm_ros/message/progress_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mpm_ros {

std::string clock_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::llround(std::max(0.0, seconds)));
  const std::int64_t hours = whole / 3600, minutes = whole / 60 % 60, rest = whole % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, rest) : fmt::format("{}:{:02}", minutes, rest);
}

void ProgressBar::show(double part, const std::function<std::string()>& text) {
  const Clock::time_point now = Clock::now();
  if (!enabled_ || now - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = now;
  constexpr int kWidth = 40;
  part = std::clamp(part, 0.0, 1.0);
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const auto full = static_cast<std::size_t>(part * kWidth);
  const std::string left = part > 0.0 ? clock_text(elapsed * (1.0 - part) / part) + " left" : "";
  // Erases to the end of the line, for a shorter text over a longer one.
  out_ << fmt::format("\r[{:<{}}] {:3.0f} %  {}  {}\x1b[K", std::string(full, '='), kWidth, 100.0 * part, text(), left)
       << std::flush;
}

void ProgressBar::clear() {
  if (enabled_ && drawn_ != Clock::time_point{}) out_ << "\r\x1b[K" << std::flush;
  drawn_ = Clock::time_point{};
}

}  // namespace mpm_ros
