#include "mpm_ros/node/pacer.hpp"

#include <algorithm>
#include <cmath>

namespace mpm_ros {

Pacer::Pacer(std::int64_t period, double factor) : factor_(factor), period_(static_cast<double>(period) / factor) {}

void Pacer::restart(Clock::time_point now) {
  start_ = begun_ = now;
  count_ = 0;
}

Pacer::Clock::time_point Pacer::deadline(std::int64_t number) const {
  const std::chrono::nanoseconds since(std::llround(period_ * static_cast<double>(number)));
  return start_ + std::chrono::duration_cast<Clock::duration>(since);
}

Pacer::Clock::time_point Pacer::soonest() const {
  const std::chrono::nanoseconds least(std::llround(kCatchUp * period_));
  return begun_ + std::chrono::duration_cast<Clock::duration>(least);
}

Pacer::Clock::duration Pacer::late(Clock::time_point now) const {
  const Clock::time_point due = std::max(deadline(count_ + 1), soonest());
  const std::chrono::nanoseconds whole(std::llround(period_));
  const Clock::duration gone = std::chrono::duration_cast<Clock::duration>(whole) - (due - now);
  return std::max(gone, Clock::duration::zero());
}

Pacer::Clock::time_point Pacer::next(Clock::time_point now) {
  ++count_;
  const Clock::time_point deadline = this->deadline(count_);
  if (now > deadline) ++overruns_;
  if (now > deadline + kLargestDebt) {
    ++given_up_;
    last_delay_ = now - deadline;
    restart(now);
    return now;
  }
  const Clock::time_point due = std::max(deadline, soonest());
  begun_ = std::max(due, now);
  return due;
}

}  // namespace mpm_ros
