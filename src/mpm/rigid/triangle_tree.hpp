// The triangles of a mesh in a bounding-volume hierarchy: the nearest one to a point, and all within a distance.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <unsupported/Eigen/BVH>
#include <vector>

#include "mpm/rigid/surface.hpp"
#include "triangle.hpp"

namespace mpm {

/// Those of a mesh, in its order.
std::vector<Triangle> triangles_of(const TriangleMesh& mesh);

class TriangleTree {
 public:
  explicit TriangleTree(const std::vector<Triangle>& triangles);
  /// Finds what nearest_of() finds among all triangles, to the bit.
  Nearest nearest(const Vec3& point) const;
  /// Writes down all triangles that are at most `distance` [m] from a point, to round-off. Returns their number; -1 if
  /// it is above `most`.
  int within(const Vec3& point, double distance, const Triangle** found, int most) const;
  /// Round-off of a coordinate of a point near the mesh [m].
  double round_off() const { return round_off_; }
  /// For Eigen::BVIntersect.
  const Eigen::KdBVH<double, 3, Triangle>& boxes() const { return tree_; }

 private:
  /// A little more than a square of a distance [m^2], so that round-off leaves nothing out.
  double with_round_off(double squared) const { return (1.0 + 1e-9) * squared + round_off_ * round_off_; }

  Eigen::KdBVH<double, 3, Triangle> tree_;
  double round_off_ = 0.0;
};

}  // namespace mpm
