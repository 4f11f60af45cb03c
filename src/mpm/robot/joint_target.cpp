#include "mpm/robot/joint_target.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {

JointTarget::JointTarget(const JointDefinition& definition) : drive_(definition.drive) {
  const double rest = drive_ == JointDrive::position ? definition.position : 0.0;
  function_ = definition.target.value_or(Function(rest));
}

void JointTarget::hold(double value) {
  held_ = true;
  value_ = value;
  knots_.clear();
}

JointKnot JointTarget::knot_at(double time) const {
  if (time >= knots_.back().time) return {time, knots_.back().position, 0.0};
  const auto after = std::upper_bound(knots_.begin(), knots_.end(), time,
                                      [](double t, const JointKnot& knot) { return t < knot.time; });
  if (after == knots_.begin()) return {time, after->position, 0.0};
  const JointKnot &a = *(after - 1), &b = *after;
  const double span = b.time - a.time, s = (time - a.time) / span, r = 1.0 - s;
  if (std::isnan(a.velocity) || std::isnan(b.velocity)) {
    return {time, r * a.position + s * b.position, (b.position - a.position) / span};
  }
  // Cubic Hermite polynomial.
  const double position = (1.0 + 2.0 * s) * r * r * a.position + s * r * r * span * a.velocity +
                          s * s * (3.0 - 2.0 * s) * b.position - s * s * r * span * b.velocity;
  const double velocity = 6.0 * s * r * (b.position - a.position) / span + r * (1.0 - 3.0 * s) * a.velocity +
                          s * (3.0 * s - 2.0) * b.velocity;
  return {time, position, velocity};
}

double JointTarget::at(double time) const {
  if (!knots_.empty()) return drive_ == JointDrive::velocity ? knot_at(time).velocity : knot_at(time).position;
  return held_ ? value_ : function_(time);
}

double JointTarget::rate(double time, double dt) const {
  if (drive_ != JointDrive::position) return 0.0;
  if (!knots_.empty()) return knot_at(time).velocity;
  return held_ || !function_.uses_time() ? 0.0 : (function_(time) - function_(time - dt)) / dt;
}

void JointTarget::serialise(StateArchive& archive) {
  archive.value("held", held_);
  archive.value("value", value_);
  std::vector<double> numbers;
  for (const JointKnot& knot : knots_) numbers.insert(numbers.end(), {knot.time, knot.position, knot.velocity});
  archive.list("knots", numbers);
  knots_.clear();
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
    knots_.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  }
}

}  // namespace mpm
