#include "mpm/robot/joint_law.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {

JointLaw JointLaw::prescribed(double velocity) {
  JointLaw law;
  law.count_ = 0;
  law.add_vertical(velocity, -kInfinity, kInfinity);
  law.actions_.drive = JointActions::Drive::rigid;
  law.actions_.target = velocity;
  return law;
}

void JointLaw::add_vertical(double velocity, double low, double high) {
  Piece& piece = pieces_[count_++];
  piece = {};
  piece.vertical = true;
  piece.least = piece.most = velocity;
  piece.low = low;
  piece.high = high;
}

double JointLaw::drive_at(double velocity) const {
  const JointActions& a = actions_;
  switch (a.drive) {
    case JointActions::Drive::effort:
      return dt_ * std::clamp(a.effort, -a.limit, a.limit);
    case JointActions::Drive::rigid:
      return velocity < a.target ? dt_ * a.limit : -dt_ * a.limit;
    default:
      return dt_ * std::clamp(a.at_rest - a.slope * velocity, -a.limit, a.limit);
  }
}

JointLaw::JointLaw(const JointActions& actions, double dt) : count_(0), actions_(actions), dt_(dt) {
  const JointActions& a = actions_;
  const double least = a.least, most = std::max(a.most, a.least);
  const bool rigid = a.drive == JointActions::Drive::rigid, spring = a.drive == JointActions::Drive::spring;
  if (least == most || (rigid && std::isinf(a.limit))) {
    add_vertical(rigid ? std::clamp(a.target, least, most) : least, -kInfinity, kInfinity);
    return;
  }
  // Velocities where pieces meet, between the limits, ascending.
  std::array<double, 4> places{};
  int count = 0;
  const auto meet = [&](double velocity) {
    if (!(velocity > least && velocity < most)) return;
    int at = count;
    while (at > 0 && places[at - 1] > velocity) --at;
    if (at > 0 && places[at - 1] == velocity) return;
    for (int i = count++; i > at; --i) places[i] = places[i - 1];
    places[at] = velocity;
  };
  if (a.friction > 0.0) meet(0.0);
  if (rigid) meet(a.target);
  if (spring && a.slope > 0.0 && std::isfinite(a.limit)) {
    meet((a.at_rest - a.limit) / a.slope);
    meet((a.at_rest + a.limit) / a.slope);
  }

  // Impulse beside a place, without what is vertical there: `from` is a velocity of the interval on that side.
  const auto impulse_at = [&](double velocity, double from) {
    const double friction = from < 0.0 ? a.friction : -a.friction;
    const double drive = spring ? drive_at(velocity) : drive_at(from);
    return drive - dt_ * a.damping * velocity + dt_ * friction;
  };
  const auto between = [&](double left, double right) {
    if (std::isinf(left)) return std::isinf(right) ? 0.0 : right - 1.0;
    return std::isinf(right) ? left + 1.0 : 0.5 * (left + right);
  };
  double left = least;
  for (int i = 0; i <= count; ++i) {
    const double right = i < count ? places[i] : most, inside = between(left, right);
    if (i == 0 && std::isfinite(least)) add_vertical(least, impulse_at(least, inside), kInfinity);
    Piece& piece = pieces_[count_++];
    piece = {};
    piece.least = left;
    piece.most = right;
    const bool falls = spring && std::abs(a.at_rest - a.slope * inside) < a.limit;
    piece.slope = dt_ * (a.damping + (falls ? a.slope : 0.0));
    piece.offset = impulse_at(inside, inside) + piece.slope * inside;
    if (i == count) {
      if (std::isfinite(most)) add_vertical(most, -kInfinity, impulse_at(most, inside));
      break;
    }
    const double after = between(right, i + 1 < count ? places[i + 1] : most);
    const double high = impulse_at(right, inside), low = impulse_at(right, after);
    if (high > low) add_vertical(right, low, high);
    left = right;
  }
}

int JointLaw::piece_at(double velocity) const {
  int i = 0;
  while (i + 1 < count_ && velocity > pieces_[i].most) ++i;
  return i;
}

JointImpulses JointLaw::parts(double velocity, double impulse) const {
  JointImpulses parts;
  const JointActions& a = actions_;
  if (is_prescribed() && a.drive == JointActions::Drive::rigid) {
    parts.drive = impulse;
    return parts;
  }
  parts.damping = -dt_ * a.damping * velocity;
  double left = impulse - parts.damping;
  const bool held = a.drive == JointActions::Drive::rigid && velocity == a.target;
  if (!held) {
    parts.drive = drive_at(velocity);
    left -= parts.drive;
  }
  const bool at_limit = velocity <= a.least || velocity >= a.most;
  if (velocity != 0.0 || held || at_limit) {
    parts.friction = velocity == 0.0 ? 0.0 : dt_ * (velocity < 0.0 ? a.friction : -a.friction);
  } else {
    parts.friction = left;  // at rest it takes what is left
  }
  left -= parts.friction;
  if (held) {
    parts.drive = std::clamp(left, -dt_ * a.limit, dt_ * a.limit);
    left -= parts.drive;
  }
  parts.limit = left;  // nothing, but at a limit, or where contact was not solved to the end
  return parts;
}

}  // namespace mpm
