// A circular cylinder about the origin, perhaps without end along its axis (a disc in planar scenes).
#include <algorithm>
#include <cmath>
#include <sstream>

#include "mpm/math/constants.hpp"
#include "mpm/rigid/surface.hpp"

namespace mpm {

namespace {

constexpr int kCylinderSegments = 48;  // segments of the display mesh

class CylinderSurface final : public Surface {
 public:
  CylinderSurface(double radius, double height, int axis) : radius_(radius), half_(0.5 * height), axis_(axis) {}

  SurfacePoint at(const Vec3& point) const override {
    const double along = point[axis_];
    Vec3 radial = point;
    radial[axis_] = 0.0;
    const double r = radial.stableNorm();
    // On the axis all radial directions are alike: the first one across it.
    radial = r > 0.0 ? Vec3(radial / r) : Vec3(Vec3::Unit((axis_ + 1) % 3));
    const Vec3 axial = (along < 0.0 ? -1.0 : 1.0) * Vec3::Unit(axis_);
    const double beyond_side = r - radius_;
    const double beyond_cap = std::abs(along) - half_;  // minus infinity when there is no cap
    SurfacePoint result;
    if (beyond_side > 0.0 && beyond_cap > 0.0) {
      result.distance = std::hypot(beyond_side, beyond_cap);
      result.normal = (beyond_side * radial + beyond_cap * axial) / result.distance;
    } else if (beyond_side >= beyond_cap) {
      result = {beyond_side, radial};
    } else {
      result = {beyond_cap, axial};
    }
    return result;
  }

  bool within(const Vec3& point, double band, SurfacePoint& result) const override {
    if (std::abs(point[axis_]) - half_ > band) return false;
    const SurfacePoint found = at(point);
    if (found.distance > band) return false;
    result = found;
    return true;
  }

  Box bounds() const override {
    Vec3 half = Vec3::Constant(radius_);
    half[axis_] = half_;
    return {-half, half};
  }

  double thickness() const override { return 2.0 * std::min(radius_, half_); }

  std::vector<TouchPoint> balls() const override {
    if (std::isfinite(half_)) return {};
    return {{Vec3::Zero(), radius_}};  // a disc of a planar scene
  }

  std::vector<std::array<Vec3, 3>> triangles() const override {
    const double half = std::isfinite(half_) ? half_ : radius_;  // without end: drawn as long as it is wide
    const int u = (axis_ + 1) % 3;
    const int v = (axis_ + 2) % 3;
    const auto vertex = [&](double radius, int segment, double along) {
      const double angle = 2.0 * kPi * (segment % kCylinderSegments) / kCylinderSegments;
      Vec3 p;
      p[axis_] = along;
      p[u] = radius * std::cos(angle);
      p[v] = radius * std::sin(angle);
      return p;
    };
    std::vector<std::array<Vec3, 3>> result;
    for (int i = 0; i < kCylinderSegments; ++i) {
      const Vec3 low = vertex(radius_, i, -half), low_next = vertex(radius_, i + 1, -half);
      const Vec3 high = vertex(radius_, i, half), high_next = vertex(radius_, i + 1, half);
      result.push_back({low, low_next, high_next});
      result.push_back({low, high_next, high});
      result.push_back({vertex(0.0, 0, half), high, high_next});
      result.push_back({vertex(0.0, 0, -half), low_next, low});
    }
    return result;
  }

  std::optional<SolidMoments> moments(double across) const override {
    const double height = std::isfinite(half_) ? 2.0 * half_ : across;
    const double volume = kPi * radius_ * radius_ * height;
    Vec3 squares = Vec3::Constant(0.25 * volume * radius_ * radius_);
    squares[axis_] = volume * height * height / 12.0;
    return centred_moments(volume, squares);
  }

 private:
  double radius_, half_;
  int axis_;
};

}  // namespace

std::unique_ptr<Surface> make_cylinder(double radius, double height, int axis) {
  std::ostringstream text;
  if (!(radius > 0.0) || std::isinf(radius)) {
    text << "cylinder: radius is " << radius << " m; it must be positive and finite";
  } else if (!(height > 0.0)) {
    text << "cylinder: height is " << height << " m; it must be positive";
  } else if (axis < 0 || axis > 2) {
    text << "cylinder: axis is " << axis << "; it must be 0, 1 or 2 for x, y or z";
  }
  if (!text.str().empty()) throw RigidError(text.str());
  return std::make_unique<CylinderSurface>(radius, height, axis);
}

}  // namespace mpm
