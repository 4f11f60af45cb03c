#include "axial_motion.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

constexpr double kNoise = 1e-6;

/// From the body's origin to its farthest corner [m]; endless axes do not count.
double reach_of(const Surface& surface) {
  const Box bounds = surface.bounds();
  const Vec3 corner = bounds.min.cwiseAbs().cwiseMax(bounds.max.cwiseAbs());
  return corner.unaryExpr([](double c) { return std::isfinite(c) ? c : 0.0; }).norm();
}

[[noreturn]] void refuse(const RigidBodyDefinition& body, const std::string& found, const char* unit) {
  throw RigidError(
      fmt::format("rigid body '{}': {} {}, but in an axisymmetric scene {}; set the others to zero, or use a "
                  "solid scene",
                  body.name, found, unit,
                  body.inner_radius > 0.0 ? "a ring moves along z and opens along x alone"
                                          : "a tool moves along z alone, on the axis"));
}

/// Leaves the components that the body may have. `what` is the name of the vector in messages.
Vec3 axial(const Vec3& vector, double size, const RigidBodyDefinition& body, const char* what, const char* unit) {
  Vec3 kept(0.0, 0.0, vector.z());
  if (body.inner_radius > 0.0) kept.x() = vector.x();
  for (int axis = 0; axis < 2; ++axis) {
    const double dropped = vector[axis] - kept[axis];
    if (std::abs(dropped) > kNoise * size)
      refuse(body, fmt::format("{} {} is {:.3g}", what, "xyz"[axis], dropped), unit);
  }
  return kept;
}

}  // namespace

Twist axial_twist(const Twist& twist, const RigidBodyDefinition& body) {
  if (!twist.linear.allFinite() || !twist.angular.allFinite()) return twist;
  const double reach = reach_of(*body.surface);
  const double size = std::max(twist.linear.norm(), twist.angular.norm() * reach);
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(twist.angular[axis]) * reach > kNoise * size) {
      refuse(body, fmt::format("rotation rate about {} is {:.3g}", "xyz"[axis], twist.angular[axis]), "rad/s");
    }
  }
  return {axial(twist.linear, size, body, "velocity along", "m/s"), Vec3::Zero()};
}

Pose axial_pose(const Pose& pose, const RigidBodyDefinition& body) {
  if (!pose.position.allFinite() || !pose.orientation.coeffs().allFinite()) return pose;
  const double turned = pose.orientation.vec().norm();
  if (turned > kNoise * pose.orientation.norm()) {
    const double angle = 2.0 * std::atan2(turned, std::abs(pose.orientation.w()));
    refuse(body, fmt::format("its pose is turned by {:.3g}", angle), "rad");
  }
  const double size = std::max(pose.position.norm(), reach_of(*body.surface));
  // The length of the quaternion is the body's own check.
  const Quat upright(pose.orientation.norm(), 0.0, 0.0, 0.0);
  return {axial(pose.position, size, body, "position along", "m"), upright};
}

}  // namespace mpm
