#include "mpm_ros/message/contact_average.hpp"

#include <utility>

namespace mpm_ros {
namespace {

/// The mean by weight of two points; not a number belongs to no weight, and must not spread.
mpm::Vec3 weighted(const mpm::Vec3& a, double weight_a, const mpm::Vec3& b, double weight_b) {
  if (!(weight_b > 0.0)) return a;
  if (!(weight_a > 0.0)) return b;
  return (weight_a * a + weight_b * b) / (weight_a + weight_b);
}

/// Means of two intervals as one of both; neither has covered any time: that of the first.
class Mean {
 public:
  Mean(double before, double added) : before_(before), added_(added) {}
  template <typename Value>
  void operator()(Value& sum, const Value& next) const {
    if (before_ + added_ > 0.0) sum = (before_ * sum + added_ * next) / (before_ + added_);
  }

 private:
  double before_, added_;  // [s]
};

void join(mpm::ContactReport& sum, const mpm::ContactReport& next) {
  sum.arm = weighted(sum.arm, sum.interval * sum.pressing, next.arm, next.interval * next.pressing);
  const Mean mean(sum.interval, next.interval);
  mean(sum.mean.force, next.mean.force);
  mean(sum.mean.torque, next.mean.torque);
  mean(sum.friction, next.friction);
  mean(sum.per_radian, next.per_radian);
  mean(sum.pressing, next.pressing);
  mean(sum.area, next.area);
  if (next.peak.force.norm() > sum.peak.force.norm()) sum.peak = next.peak;
  sum.interval += next.interval;
  sum.origin = next.origin;
  sum.nodes = next.nodes;
  sum.impulse = next.impulse;
  sum.friction_energy = next.friction_energy;
}

void join(mpm::PairReport& sum, const mpm::PairReport& next) {
  sum.centre = weighted(sum.centre, sum.interval * sum.pressing, next.centre, next.interval * next.pressing);
  const Mean mean(sum.interval, next.interval);
  mean(sum.force, next.force);
  mean(sum.friction, next.friction);
  mean(sum.pressing, next.pressing);
  sum.interval += next.interval;
  sum.area = next.area;
  sum.nodes = next.nodes;
  sum.impulse = next.impulse;
  sum.friction_energy = next.friction_energy;
  sum.interface_energy = next.interface_energy;
}

}  // namespace

void ContactAverage::add(const Contacts& contacts) {
  if (std::exchange(empty_, false)) {
    sum_ = contacts;
    return;
  }
  for (std::size_t body = 0; body < contacts.bodies.size(); ++body) join(sum_.bodies[body], contacts.bodies[body]);
  for (std::size_t pair = 0; pair < contacts.pairs.size(); ++pair) join(sum_.pairs[pair], contacts.pairs[pair]);
}

Contacts ContactAverage::take() {
  empty_ = true;
  return std::exchange(sum_, {});
}

void Contacts::keep(mpm::StateArchive& archive) {
  archive.rows("bodies", bodies);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const mpm::StateArchive::Group group(archive, "body_" + std::to_string(b));
    mpm::ContactReport& one = bodies[b];
    archive.keep("name", one.body);
    archive.keep("force", one.mean.force);
    archive.keep("torque", one.mean.torque);
    archive.keep("peak_force", one.peak.force);
    archive.keep("peak_torque", one.peak.torque);
    archive.keep("interval", one.interval);
    archive.keep("nodes", one.nodes);
    archive.keep("impulse", one.impulse);
    archive.keep("area", one.area);
    archive.keep("friction_energy", one.friction_energy);
    archive.keep("pressing", one.pressing);
    archive.keep("friction", one.friction);
    archive.keep("per_radian", one.per_radian);
    archive.keep("origin", one.origin);
    archive.keep("arm", one.arm);
  }
  archive.rows("pairs", pairs);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const mpm::StateArchive::Group group(archive, "pair_" + std::to_string(p));
    mpm::PairReport& one = pairs[p];
    archive.keep("name", one.name);
    archive.keep("force", one.force);
    archive.keep("friction", one.friction);
    archive.keep("pressing", one.pressing);
    archive.keep("area", one.area);
    archive.keep("interval", one.interval);
    archive.keep("nodes", one.nodes);
    archive.keep("impulse", one.impulse);
    archive.keep("friction_energy", one.friction_energy);
    archive.keep("interface_energy", one.interface_energy);
    archive.keep("centre", one.centre);
  }
}

void ContactAverage::keep(mpm::StateArchive& archive) {
  archive.keep("empty", empty_);
  sum_.keep(archive);
}

}  // namespace mpm_ros
