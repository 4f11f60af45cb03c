#include "mpm_ros/message/progress_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mpm_ros {

namespace {

/// "0:07 left"; nothing before the work has begun.
std::string time_left(double part, double elapsed) {
  return part > 0.0 ? clock_text(elapsed * (1.0 - part) / part) + " left" : "";
}

}  // namespace

std::string clock_text(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::llround(std::max(0.0, seconds)));
  const std::int64_t hours = whole / 3600, minutes = whole / 60 % 60, rest = whole % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, rest) : fmt::format("{}:{:02}", minutes, rest);
}

void ProgressBar::show(double part, const std::function<std::string()>& text) {
  const Clock::time_point now = Clock::now();
  part = std::clamp(part, 0.0, 1.0);
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  if (!terminal_) {
    if (now - start_ >= quiet_) write_line(part, elapsed, text);
    return;
  }
  if (now - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = now;
  constexpr int kWidth = 40;
  const auto full = static_cast<std::size_t>(part * kWidth);
  // Erases to the end of the line, for a shorter text over a longer one.
  out_ << fmt::format("\r[{:<{}}] {:3.0f} %  {}  {}\x1b[K", std::string(full, '='), kWidth, 100.0 * part, text(),
                      time_left(part, elapsed))
       << std::flush;
}

void ProgressBar::write_line(double part, double elapsed, const std::function<std::string()>& text) {
  const int tenths = static_cast<int>(10.0 * part + 1e-9);
  if (tenths <= tenths_ || tenths >= 10) return;  // the end has a summary of its own
  tenths_ = tenths;
  // The line may come late, so it says how much is done and not which tenth it stands for.
  out_ << fmt::format("{:3d} %  {}  {}\n", static_cast<int>(100.0 * part + 1e-9), text(), time_left(part, elapsed))
       << std::flush;
}

void ProgressBar::clear() {
  if (terminal_ && drawn_ != Clock::time_point{}) out_ << "\r\x1b[K" << std::flush;
  drawn_ = Clock::time_point{};
}

}  // namespace mpm_ros
