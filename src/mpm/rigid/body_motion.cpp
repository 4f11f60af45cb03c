#include "mpm/rigid/body_motion.hpp"

#include <sstream>

namespace mpm {

Vec3 RingMotion::velocity_at(const Pose& pose, const Twist& twist, const Vec3& point) const {
  Vec3 velocity = mpm::velocity_at(pose, twist, point);
  const double inner = inner_ + pose.position.x(), outer = outer_ + pose.position.x();
  velocity.x() *= point.x() / (point.x() < 0.5 * (inner + outer) ? inner : outer);
  return velocity;
}

std::string RingMotion::refused(const Pose& pose) const {
  if (inner_ + pose.position.x() > 0.0) return {};
  std::ostringstream text;
  text << "the ring has closed: its inner radius, " << inner_ << " m, has changed by " << pose.position.x()
       << " m; keep position.x above " << -inner_ << " m";
  return text.str();
}

}  // namespace mpm
