// A cylinder with round ends: all that is near a straight piece of a line. In a plane a stadium.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/math/constants.hpp"
#include "mpm/rigid/surface.hpp"

namespace mpm {

namespace {

constexpr int kCapsuleMeridians = 32;  // meridians of the display mesh
constexpr double kBalls = 4.0;         // balls to touch with, in a radius of the axis
constexpr int kEndParallels = 8;       // parallels of each end

class CapsuleSurface final : public Surface {
 public:
  CapsuleSurface(double radius, double length, int axis, bool in_plane)
      : radius_(radius), half_(0.5 * length), axis_(axis), in_plane_(in_plane) {}

  SurfacePoint at(const Vec3& point) const override {
    Vec3 arm = point;  // from the nearest point of the middle line
    arm[axis_] -= std::clamp(point[axis_], -half_, half_);
    if (in_plane_) arm.y() = 0.0;
    const double r = arm.stableNorm();
    // On the line itself all directions across it are alike: x, or z where x is the line.
    return {r - radius_, r > 0.0 ? Vec3(arm / r) : Vec3(axis_ == 0 ? Vec3::UnitZ() : Vec3::UnitX())};
  }

  bool within(const Vec3& point, double band, SurfacePoint& result) const override {
    if (std::abs(point[axis_]) - half_ - radius_ > band) return false;
    const SurfacePoint found = at(point);
    if (found.distance > band) return false;
    result = found;
    return true;
  }

  Box bounds() const override {
    Vec3 half = Vec3::Constant(radius_);
    half[axis_] += half_;
    if (in_plane_) half.y() = std::numeric_limits<double>::infinity();
    return {-half, half};
  }

  double thickness() const override { return 2.0 * radius_; }

  std::vector<TouchPoint> balls() const override {
    const int parts = std::max(1, static_cast<int>(std::ceil(kBalls * 2.0 * half_ / radius_)));
    std::vector<TouchPoint> balls;
    for (int k = 0; k <= parts; ++k) balls.push_back({(2.0 * k / parts - 1.0) * half_ * Vec3::Unit(axis_), radius_});
    return balls;
  }

  std::vector<std::array<Vec3, 3>> triangles() const override {
    // Parallels from one pole to the other; the equator is there twice, at both ends of the straight part.
    const int last = 2 * kEndParallels + 1;
    const auto vertex = [&](int parallel, int meridian) {
      const bool upper = parallel <= kEndParallels;
      const double theta = 0.5 * kPi * (upper ? parallel : parallel - 1) / kEndParallels;
      const double phi = 2.0 * kPi * (meridian % kCapsuleMeridians) / kCapsuleMeridians;
      const double ring = parallel == 0 || parallel == last ? 0.0 : radius_ * std::sin(theta);  // one vertex a pole
      Vec3 p;
      p[axis_] = radius_ * std::cos(theta) + (upper ? half_ : -half_);
      p[(axis_ + 1) % 3] = ring * std::cos(phi);
      p[(axis_ + 2) % 3] = ring * std::sin(phi);
      return p;
    };
    std::vector<std::array<Vec3, 3>> result;
    for (int i = 0; i < last; ++i) {
      for (int j = 0; j < kCapsuleMeridians; ++j) {
        if (i + 1 < last) result.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
        if (i > 0) result.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      }
    }
    return result;
  }

  // The straight part and two halves of a ball or disc, whose centres of mass lie beyond its ends.
  std::optional<SolidMoments> moments(double across) const override {
    const double r = radius_, r2 = r * r, length = 2.0 * half_;
    const double depth = in_plane_ ? across : 1.0;
    const double straight = (in_plane_ ? 2.0 * r * depth : kPi * r2) * length;
    const double ends = in_plane_ ? kPi * r2 * depth : 4.0 / 3.0 * kPi * r2 * r;
    const double beyond = in_plane_ ? 4.0 * r / (3.0 * kPi) : 0.375 * r;
    const double of_ends = ends * r2 / (in_plane_ ? 4.0 : 5.0);  // moment of a whole disc or ball about its centre
    const double volume = straight + ends;
    Vec3 squares = Vec3::Constant(straight * r2 / (in_plane_ ? 3.0 : 4.0) + of_ends);
    squares[axis_] = straight * length * length / 12.0 + ends * (half_ * half_ + 2.0 * half_ * beyond) + of_ends;
    if (in_plane_) squares.y() = volume * depth * depth / 12.0;
    return centred_moments(volume, squares);
  }

 private:
  double radius_, half_;
  int axis_;
  bool in_plane_;
};

}  // namespace

std::unique_ptr<Surface> make_capsule(double radius, double length, int axis, bool in_plane) {
  for (const auto& [name, value] : {std::pair("radius", radius), std::pair("length", length)}) {
    if (!(value > 0.0) || std::isinf(value))
      throw RigidError(fmt::format("capsule: {} is {:g} m; it must be positive and finite", name, value));
  }
  if (axis < 0 || axis > 2 || (in_plane && axis == 1)) {
    throw RigidError(
        fmt::format("capsule: axis is {}; it must be 0, 1 or 2 for x, y or z, and not y in a plane", axis));
  }
  return std::make_unique<CapsuleSurface>(radius, length, axis, in_plane);
}

}  // namespace mpm
