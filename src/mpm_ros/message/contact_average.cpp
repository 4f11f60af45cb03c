#include "mpm_ros/message/contact_average.hpp"

#include <utility>

namespace mpm_ros {

void ContactAverage::add(const std::vector<mpm::ContactReport>& reports) {
  if (sum_.empty()) {
    sum_ = reports;
    return;
  }
  for (std::size_t body = 0; body < reports.size(); ++body) {
    mpm::ContactReport& sum = sum_[body];
    const mpm::ContactReport& next = reports[body];
    const double interval = sum.interval + next.interval;
    // Arms go by the normal impulse; nothing pressed, no arm (not a number, which must not spread).
    const double before = sum.interval * sum.pressing, added = next.interval * next.pressing;
    if (added > 0.0)
      sum.arm = before > 0.0 ? mpm::Vec3((before * sum.arm + added * next.arm) / (before + added)) : next.arm;
    sum.origin = next.origin;
    if (interval > 0.0) {
      const auto mean = [&](const auto& a, const auto& b) { return (sum.interval * a + next.interval * b) / interval; };
      sum.mean.force = mean(sum.mean.force, next.mean.force);
      sum.mean.torque = mean(sum.mean.torque, next.mean.torque);
      sum.friction = mean(sum.friction, next.friction);
      sum.per_radian = mean(sum.per_radian, next.per_radian);
      sum.pressing = mean(sum.pressing, next.pressing);
    }
    if (next.peak.force.norm() > sum.peak.force.norm()) sum.peak = next.peak;
    sum.interval = interval;
    sum.nodes = next.nodes;
    sum.impulse = next.impulse;
  }
}

std::vector<mpm::ContactReport> ContactAverage::take() { return std::exchange(sum_, {}); }

}  // namespace mpm_ros
