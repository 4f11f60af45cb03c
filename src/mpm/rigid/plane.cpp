// A half space: all that lies behind a plane through the origin.
#include <fmt/core.h>

#include <cmath>

#include "mpm/math/constants.hpp"
#include "mpm/rigid/surface.hpp"

namespace mpm {

namespace {

constexpr double kDrawnDepth = 0.05;  // depth as part of the slab's side

class PlaneSurface final : public Surface {
 public:
  PlaneSurface(const Vec3& normal, double drawn) : normal_(normal), drawn_(drawn) {}

  SurfacePoint at(const Vec3& point) const override { return {normal_.dot(point), normal_}; }

  bool within(const Vec3& point, double band, SurfacePoint& result) const override {
    const double distance = normal_.dot(point);
    if (distance > band) return false;
    result = {distance, normal_};
    return true;
  }

  Box bounds() const override {
    // Only a plane across an axis ends along it.
    Box bounds{Vec3::Constant(-kInfinity), Vec3::Constant(kInfinity)};
    for (int axis = 0; axis < 3; ++axis) {
      if (normal_[axis] == 1.0) bounds.max[axis] = 0.0;
      if (normal_[axis] == -1.0) bounds.min[axis] = 0.0;
    }
    return bounds;
  }

  double thickness() const override { return kInfinity; }

  std::vector<std::array<Vec3, 3>> triangles() const override {
    // Edges along the body's axes where the plane is: of a planar scene's slab one is along y.
    int across = 0;
    normal_.cwiseAbs().minCoeff(&across);
    Mat3 axes;
    axes.col(1) = (Vec3::Unit(across) - normal_[across] * normal_).normalized();
    axes.col(2) = normal_;
    axes.col(0) = axes.col(1).cross(normal_);
    const double depth = kDrawnDepth * drawn_;
    std::vector<std::array<Vec3, 3>> result = make_box({drawn_, drawn_, depth})->triangles();
    for (auto& triangle : result) {
      for (Vec3& corner : triangle) corner = axes * (corner - Vec3(0.0, 0.0, 0.5 * depth));
    }
    return result;
  }

 private:
  Vec3 normal_;
  double drawn_;
};

}  // namespace

std::unique_ptr<Surface> make_plane(const Vec3& normal, double drawn) {
  if (!normal.allFinite() || !(normal.norm() > 0.0)) {
    throw RigidError(
        fmt::format("plane: normal is ({:g}, {:g}, {:g}); write the direction out of the body, such as "
                    "(0, 0, 1)",
                    normal.x(), normal.y(), normal.z()));
  }
  if (!(drawn > 0.0) || std::isinf(drawn))
    throw RigidError(fmt::format("plane: its drawn side is {:g} m; it must be positive and finite", drawn));
  return std::make_unique<PlaneSurface>(normal.stableNormalized(), drawn);
}

}  // namespace mpm
