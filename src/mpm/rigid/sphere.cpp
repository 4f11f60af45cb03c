// A sphere about the origin.
#include <cmath>
#include <sstream>

#include "mpm/math/constants.hpp"
#include "mpm/rigid/surface.hpp"

namespace mpm {

namespace {

constexpr int kSphereMeridians = 32;  // meridians of the display mesh
constexpr int kSphereParallels = 16;

class SphereSurface final : public Surface {
 public:
  explicit SphereSurface(double radius) : radius_(radius) {}

  SurfacePoint at(const Vec3& point) const override {
    SurfacePoint result;  // at the centre all directions are alike: z
    const double r = point.stableNorm();
    result.distance = r - radius_;
    if (r > 0.0) result.normal = point / r;
    return result;
  }

  bool within(const Vec3& point, double band, SurfacePoint& result) const override {
    const SurfacePoint found = at(point);
    if (found.distance > band) return false;
    result = found;
    return true;
  }

  Box bounds() const override { return {Vec3::Constant(-radius_), Vec3::Constant(radius_)}; }

  double thickness() const override { return 2.0 * radius_; }

  std::vector<TouchPoint> balls() const override { return {{Vec3::Zero(), radius_}}; }

  std::vector<std::array<Vec3, 3>> triangles() const override {
    const auto vertex = [&](int parallel, int meridian) {
      const double theta = kPi * parallel / kSphereParallels;
      const double phi = 2.0 * kPi * (meridian % kSphereMeridians) / kSphereMeridians;
      const double ring = parallel == 0 || parallel == kSphereParallels ? 0.0 : std::sin(theta);  // one vertex a pole
      return Vec3(radius_ * Vec3(ring * std::cos(phi), ring * std::sin(phi), std::cos(theta)));
    };
    std::vector<std::array<Vec3, 3>> result;
    for (int i = 0; i < kSphereParallels; ++i) {
      for (int j = 0; j < kSphereMeridians; ++j) {
        if (i + 1 < kSphereParallels) result.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
        if (i > 0) result.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      }
    }
    return result;
  }

  std::optional<SolidMoments> moments(double) const override {
    const double volume = 4.0 / 3.0 * kPi * radius_ * radius_ * radius_;
    return centred_moments(volume, Vec3::Constant(volume * radius_ * radius_ / 5.0));
  }

 private:
  double radius_;
};

}  // namespace

std::unique_ptr<Surface> make_sphere(double radius) {
  if (!(radius > 0.0) || std::isinf(radius)) {
    std::ostringstream text;
    text << "sphere: radius is " << radius << " m; it must be positive and finite";
    throw RigidError(text.str());
  }
  return std::make_unique<SphereSurface>(radius);
}

}  // namespace mpm
