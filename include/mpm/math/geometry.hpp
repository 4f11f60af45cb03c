// Points, rotations and boxes of the world frame (right-handed, z up, SI). Eigen types; kernels do not use them.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>

namespace mpm {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

/// Axis-aligned box [m]; empty until the first point is added.
struct Box {
  Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 max = Vec3::Constant(-std::numeric_limits<double>::infinity());

  void add(const Vec3& point) {
    min = min.cwiseMin(point);
    max = max.cwiseMax(point);
  }
  bool empty() const { return (min.array() > max.array()).any(); }
  bool contains(const Vec3& point) const {
    return (point.array() >= min.array()).all() && (point.array() <= max.array()).all();
  }
  bool intersects(const Box& other) const {
    return (min.array() <= other.max.array()).all() && (other.min.array() <= max.array()).all();
  }
  Box grown(double margin) const { return {min.array() - margin, max.array() + margin}; }
  Vec3 size() const { return max - min; }
  Vec3 center() const { return 0.5 * (min + max); }
};

}  // namespace mpm
