#include "mpm_ros/node/pacer.hpp"

namespace mpm_ros {

Pacer::Pacer(std::int64_t period, double factor)
    : period_(std::chrono::duration_cast<Clock::duration>(
          std::chrono::duration<double, std::nano>(static_cast<double>(period) / factor))) {}

Pacer::Clock::time_point Pacer::next(Clock::time_point now) {
  deadline_ += period_;
  if (now > deadline_) ++overruns_;
  if (now > deadline_ + kLargestDebt) deadline_ = now;
  return deadline_;
}

}  // namespace mpm_ros
