#include "mpm_ros/node/pacer.hpp"

#include <algorithm>
#include <cmath>

namespace mpm_ros {

Pacer::Pacer(std::int64_t period, double factor) : factor_(factor), period_(static_cast<double>(period) / factor) {}

void Pacer::restart(Clock::time_point now) {
  start_ = begun_ = now;
  count_ = 0;
}

Pacer::Clock::time_point Pacer::next(Clock::time_point now) {
  ++count_;
  const std::chrono::nanoseconds since(std::llround(period_ * static_cast<double>(count_)));
  const Clock::time_point deadline = start_ + std::chrono::duration_cast<Clock::duration>(since);
  if (now > deadline) ++overruns_;
  if (now > deadline + kLargestDebt) {
    ++given_up_;
    last_delay_ = now - deadline;
    restart(now);
    return now;
  }
  const std::chrono::nanoseconds least(std::llround(kCatchUp * period_));
  const Clock::time_point due = std::max(deadline, begun_ + std::chrono::duration_cast<Clock::duration>(least));
  begun_ = std::max(due, now);
  return due;
}

}  // namespace mpm_ros
