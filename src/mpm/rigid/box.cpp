// A box about the origin, perhaps without end along an axis (planar scenes) or two (lines).
#include <cmath>
#include <limits>
#include <sstream>

#include "mpm/rigid/surface.hpp"

namespace mpm {

namespace {

/// -1 or 1; zero counts as positive, so that the normal is defined at the centre too.
double side(double x) { return x < 0.0 ? -1.0 : 1.0; }

class BoxSurface final : public Surface {
 public:
  explicit BoxSurface(const Vec3& size) : half_(0.5 * size) {}

  SurfacePoint at(const Vec3& point) const override {
    const Vec3 excess = point.cwiseAbs() - half_;  // minus infinity along an axis without end
    SurfacePoint result;
    const Vec3 outside = excess.cwiseMax(0.0);
    int axis = 0;
    const double nearest_face = excess.maxCoeff(&axis);
    if (nearest_face > 0.0) {
      result.distance = outside.stableNorm();
      result.normal = outside / result.distance;
      for (int i = 0; i < 3; ++i) result.normal[i] *= side(point[i]);
    } else {
      result.distance = nearest_face;
      result.normal = side(point[axis]) * Vec3::Unit(axis);
    }
    return result;
  }

  bool within(const Vec3& point, double band, SurfacePoint& result) const override {
    // The distance is at least the excess over any one face.
    if (((point.cwiseAbs() - half_).array() > band).any()) return false;
    const SurfacePoint found = at(point);
    if (found.distance > band) return false;
    result = found;
    return true;
  }

  Box bounds() const override { return {-half_, half_}; }

  double thickness() const override { return 2.0 * half_.minCoeff(); }

  std::vector<std::array<Vec3, 3>> triangles() const override {
    // An axis without end is drawn as long as the longest of the others.
    Vec3 half = half_;
    double longest = 0.0;
    for (int i = 0; i < 3; ++i) {
      if (std::isfinite(half[i])) longest = std::max(longest, half[i]);
    }
    for (int i = 0; i < 3; ++i) {
      if (!std::isfinite(half[i])) half[i] = longest;
    }
    std::vector<std::array<Vec3, 3>> result;
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3;  // axis, u, v right-handed: counter-clockwise in (u, v) seen from +axis
      const int v = (axis + 2) % 3;
      for (const double sign : {-1.0, 1.0}) {
        const auto corner = [&](double su, double sv) {
          Vec3 c;
          c[axis] = sign * half[axis];
          c[u] = su * half[u];
          c[v] = sign * sv * half[v];  // mirrored on the negative face, so that it is seen from its own side
          return c;
        };
        result.push_back({corner(-1, -1), corner(1, -1), corner(1, 1)});
        result.push_back({corner(-1, -1), corner(1, 1), corner(-1, 1)});
      }
    }
    return result;
  }

  std::optional<SolidMoments> moments(double across) const override {
    Vec3 size = 2.0 * half_;
    // Side `across` stands for a line: the square on it is the area.
    for (int i = 0; i < 3; ++i) {
      if (std::isinf(size[i])) size[i] = across;
    }
    const double volume = size.prod();
    return centred_moments(volume, volume / 12.0 * size.cwiseAbs2());
  }

 private:
  Vec3 half_;
};

}  // namespace

std::unique_ptr<Surface> make_box(const Vec3& size) {
  int endless = 0;
  for (int i = 0; i < 3; ++i) {
    if (!(size[i] > 0.0)) {
      std::ostringstream text;
      text << "box: edge length along "
           << "xyz"[i] << " is " << size[i] << " m; all three must be positive";
      throw RigidError(text.str());
    }
    if (std::isinf(size[i])) ++endless;
  }
  if (endless > 2) throw RigidError("box: all edge lengths are infinite; at most two may be");
  return std::make_unique<BoxSurface>(size);
}

}  // namespace mpm
