// A body of revolution: a closed polygon in the half plane (r, z), turned about the body's z axis.
//
// A point's distance to it is that of (hypot(x, y), z) to the polygon (outline.hpp): the part of the body at the
// point's own angle is the nearest. An edge on the axis is inside the body and is no surface.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "mpm/math/constants.hpp"
#include "mpm/rigid/surface.hpp"
#include "outline.hpp"

namespace mpm {

namespace {

constexpr int kRevolvedSegments = 48;  // segments of the display mesh
constexpr int kSamples = 64;           // samples of an edge, for the thickness
// Faces that enclose less than 45 degrees are the two sides of a wall; more is an edge or a tip that ends a body.
const double kOpposed = std::cos(0.25 * kPi);
constexpr double kThinPart = 0.05;  // part of the surface: less may be thinner than the thickness

class RevolvedSurface final : public Surface {
 public:
  RevolvedSurface(const Profile& profile, bool in_half_plane)
      : outline_(profile, true), in_half_plane_(in_half_plane), low_(outline_.low()), high_(outline_.high()) {
    thickness_ = find_thickness();
  }

  SurfacePoint at(const Vec3& point) const override {
    if (in_half_plane_) {
      const auto [distance, normal] = outline_.nearest({point.x(), point.z()});
      return {distance, {normal.x(), 0.0, normal.y()}};
    }
    const double r = std::hypot(point.x(), point.y());
    const auto [distance, normal] = outline_.nearest({r, point.z()});
    if (r > 0.0) return {distance, {normal.x() * (point.x() / r), normal.x() * (point.y() / r), normal.y()}};
    // On the axis no direction across it stands out. Where the surface beside it is all that is near: the nearer end.
    const bool up = normal.y() != 0.0 ? normal.y() > 0.0 : 2.0 * point.z() >= low_.y() + high_.y();
    return {distance, up ? Vec3(Vec3::UnitZ()) : Vec3(-Vec3::UnitZ())};
  }

  bool within(const Vec3& point, double band, SurfacePoint& result) const override {
    const double r = in_half_plane_ ? point.x() : std::hypot(point.x(), point.y());
    if (point.z() - high_.y() > band || low_.y() - point.z() > band || r - high_.x() > band || low_.x() - r > band)
      return false;
    const SurfacePoint found = at(point);
    if (found.distance > band) return false;
    result = found;
    return true;
  }

  Box bounds() const override {
    return {{in_half_plane_ ? low_.x() : -high_.x(), -high_.x(), low_.y()}, {high_.x(), high_.x(), high_.y()}};
  }

  double thickness() const override { return thickness_; }

  std::vector<std::array<Vec3, 3>> triangles() const override {
    const auto vertex = [](const Vec2& p, int segment) {
      const double angle = 2.0 * kPi * (segment % kRevolvedSegments) / kRevolvedSegments;
      return Vec3(p.x() * std::cos(angle), p.x() * std::sin(angle), p.y());
    };
    std::vector<std::array<Vec3, 3>> result;
    for (const OutlineEdge& edge : outline_.edges()) {
      for (int i = 0; i < kRevolvedSegments; ++i) {
        const Vec3 from = vertex(edge.from, i), from_next = vertex(edge.from, i + 1);
        const Vec3 to = vertex(edge.to, i), to_next = vertex(edge.to, i + 1);
        if (edge.from.x() > 0.0) result.push_back({from, from_next, to_next});
        if (edge.to.x() > 0.0) result.push_back({from, to_next, to});
      }
    }
    return result;
  }

 private:
  /// Distance that a ray inwards from a point of the surface goes, through the axis and on, until it leaves through a
  /// face opposite; nothing where that face is not opposite (kOpposed).
  std::optional<double> depth(const Vec2& origin, const Vec2& inwards, const OutlineEdge* own) const {
    double least = std::numeric_limits<double>::infinity();
    bool opposed = false;
    for (const OutlineEdge& e : outline_.edges()) {
      for (const double side : {1.0, -1.0}) {  // the other half is the mirror image
        if (&e == own && side > 0.0) continue;
        const Vec2 from(side * e.from.x(), e.from.y()), to(side * e.to.x(), e.to.y());
        const Vec2 normal(side * e.normal.x(), e.normal.y());
        const double leaving = inwards.dot(normal);
        if (leaving <= 0.0) continue;
        const double length = (from - origin).dot(normal) / leaving;
        const Vec2 hit = origin + length * inwards;
        if (length <= 0.0 || length >= least || (hit - from).dot(hit - to) > 0.0) continue;
        least = length;
        opposed = leaving > kOpposed;
      }
    }
    return opposed ? std::optional<double>(least) : std::nullopt;
  }

  double find_thickness() const {
    std::vector<std::pair<double, double>> found;  // depth, area
    double total = 0.0;
    for (const OutlineEdge& edge : outline_.edges()) {
      for (int i = 0; i < kSamples; ++i) {
        const Vec2 point = edge.from + (i + 0.5) / kSamples * (edge.to - edge.from);
        const double area = point.x() * edge.length;  // but for a factor
        total += area;
        if (const auto length = depth(point, -edge.normal, &edge)) found.emplace_back(*length, area);
      }
    }
    std::sort(found.begin(), found.end());
    double below = 0.0;
    for (const auto& [length, area] : found) {
      below += area;
      if (below >= kThinPart * total) return length;
    }
    return std::min(2.0 * high_.x(), high_.y() - low_.y());
  }

  Outline outline_;
  bool in_half_plane_;
  Vec2 low_, high_;
  double thickness_ = 0.0;
};

void require_positive(const char* shape, const char* what, double value) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw RigidError(fmt::format("{}: {} is {:g} m; it must be positive and finite", shape, what, value));
}

}  // namespace

std::unique_ptr<Surface> make_revolved(const Profile& profile) {
  check_outline(profile, "revolved", true);
  return std::make_unique<RevolvedSurface>(profile, false);
}

std::unique_ptr<Surface> make_cone(double radius, double height, double shaft) {
  require_positive("cone", "radius", radius);
  require_positive("cone", "height", height);
  if (!(shaft >= 0.0) || std::isinf(shaft))
    throw RigidError(fmt::format("cone: shaft is {:g} m; it must be finite and not negative", shaft));
  Profile profile = {{0.0, 0.0}, {radius, height}};
  if (shaft > 0.0) profile.emplace_back(radius, height + shaft);
  profile.emplace_back(0.0, height + shaft);
  return make_revolved(profile);
}

std::unique_ptr<Surface> make_ring(double inner, double outer, double height, bool in_half_plane) {
  require_positive("ring", "inner", inner);
  require_positive("ring", "outer", outer);
  require_positive("ring", "height", height);
  if (!(outer > inner)) {
    throw RigidError(fmt::format("ring: outer, {:g} m, is not greater than inner, {:g} m", outer, inner));
  }
  const double half = 0.5 * height;
  const Profile profile = {{inner, -half}, {outer, -half}, {outer, half}, {inner, half}};
  return std::make_unique<RevolvedSurface>(profile, in_half_plane);
}

}  // namespace mpm
