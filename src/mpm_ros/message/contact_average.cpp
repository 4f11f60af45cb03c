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
    if (interval > 0.0) {
      sum.mean.force = (sum.interval * sum.mean.force + next.interval * next.mean.force) / interval;
      sum.mean.torque = (sum.interval * sum.mean.torque + next.interval * next.mean.torque) / interval;
    }
    if (next.peak.force.norm() > sum.peak.force.norm()) sum.peak = next.peak;
    sum.interval = interval;
    sum.nodes = next.nodes;
    sum.impulse = next.impulse;
  }
}

std::vector<mpm::ContactReport> ContactAverage::take() { return std::exchange(sum_, {}); }

}  // namespace mpm_ros
