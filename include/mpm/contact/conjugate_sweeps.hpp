// Nonlinear conjugate gradients around the sweeps of contact: a sweep's change of the impulses stands for the gradient,
// and each sweep is continued along the direction of those before it, until the changes grow (then the direction is
// forgotten). A last sweep has to follow, which brings the impulses back to what friction and pressing allow.
//
// Plain sweeps need as many rounds as a body is lighter than the nodes that it touches; these need about the root of
// it. Source: Silcowitz-Hansen, Niebe & Erleben (2010), A nonsmooth nonlinear conjugate gradient method for interactive
// contact force problems, algorithm 1; changes are weighted here by the compliance of their points.
#pragma once

#include <vector>

#include "mpm/math/geometry.hpp"

namespace mpm {

/// Kept from solve to solve, so that nothing is allocated.
struct SweepMemory {
  std::vector<Vec3> before;     ///< impulses [N s]
  std::vector<Vec3> direction;  ///< [N s]
};

/// `Point` has an `impulse` [N s] and an array `with_body`, whose first number is the compliance along the normal
/// [1/kg].
template <class Point>
class ConjugateSweeps {
 public:
  explicit ConjugateSweeps(SweepMemory& memory) : memory_(memory) {}

  /// Call before each sweep.
  void begin(const std::vector<Point>& points) {
    if (last_ < 0.0) memory_.direction.assign(points.size(), Vec3::Zero());
    memory_.before.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) memory_.before[i] = points[i].impulse;
  }

  /// Weighted square of the changes since begin().
  double change(const std::vector<Point>& points) const {
    double now = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      now += points[i].with_body[0] * (points[i].impulse - memory_.before[i]).squaredNorm();
    }
    return now;
  }

  /// Call after each sweep: `add(point, impulse)` is called for every point, with an impulse along the earlier
  /// directions. `now`: change() of all points that are solved together.
  template <class Add>
  void go_on(std::vector<Point>& points, double now, Add&& add) {
    const double part = last_ > 0.0 ? now / last_ : 0.0;
    const bool again = part > 1.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 change = points[i].impulse - memory_.before[i];
      Vec3& direction = memory_.direction[i];
      const Vec3 along = again ? Vec3(Vec3::Zero()) : Vec3(part * direction);
      if (!again) add(points[i], along);
      direction = along + change;
    }
    last_ = now;
  }

 private:
  SweepMemory& memory_;
  double last_ = -1.0;  ///< weighted square of the last sweep's change; negative before the first
};

}  // namespace mpm
