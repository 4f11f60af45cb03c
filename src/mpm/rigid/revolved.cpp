// A body of revolution: a closed polygon in the half plane (r, z), turned about the body's z axis.
//
// A point's distance to it is that of (hypot(x, y), z) to the polygon: the part of the body at the point's own angle is
// the nearest. An edge on the axis is inside the body and is no surface. Which side a point lies on is told by the
// normal at the nearest point, at a corner by the sum of its edges' normals (Baerentzen & Aanaes 2005); a corner on the
// axis has its mirror image's edge beside its own.
//
// Weak: every edge is looked at, so a profile of hundreds of points is slow; curves are as smooth as their points.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "mpm/rigid/surface.hpp"

namespace mpm {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kSegments = 48;  // of the display mesh
constexpr int kSamples = 64;   // of an edge, for the thickness
// Faces that enclose less than 45 degrees are the two sides of a wall; more is an edge or a tip that ends a body.
const double kOpposed = std::cos(0.25 * kPi);
constexpr double kThinPart = 0.05;  // of the surface: less may be thinner than the thickness

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Twice the signed area; positive when counter-clockwise, r to the right and z up.
double twice_area(const Profile& profile) {
  double sum = 0.0;
  for (std::size_t i = 0; i < profile.size(); ++i) sum += cross(profile[i], profile[(i + 1) % profile.size()]);
  return sum;
}

/// The profile with the number of a point, for a reader who counts from 1.
std::string point_text(const Profile& profile, std::size_t i) {
  return fmt::format("point {} of {}, (r, z) = ({:g}, {:g}) m", i + 1, profile.size(), profile[i].x(), profile[i].y());
}

/// Whether two edges have a point in common.
bool touch(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double c_side = cross(b - a, c - a), d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c), b_side = cross(d - c, b - c);
  if (c_side * d_side < 0.0 && a_side * b_side < 0.0) return true;
  const auto within = [](const Vec2& p, const Vec2& from, const Vec2& to) {
    return (p - from).dot(p - to) <= 0.0;  // of a point on the line
  };
  return (c_side == 0.0 && within(c, a, b)) || (d_side == 0.0 && within(d, a, b)) ||
         (a_side == 0.0 && within(a, c, d)) || (b_side == 0.0 && within(b, c, d));
}

void check_points(const Profile& profile) {
  const std::size_t n = profile.size();
  if (n < 3) throw RigidError(fmt::format("revolved: the profile has {} points; it needs at least 3", n));
  for (std::size_t i = 0; i < n; ++i) {
    const auto refuse = [&](const char* what) {
      throw RigidError(fmt::format("revolved: {} {}", point_text(profile, i), what));
    };
    if (!profile[i].allFinite()) refuse("is not finite");
    if (profile[i].x() < 0.0) refuse("has r < 0; the profile lies on one side of the axis, r >= 0");
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    if (profile[i] == profile[next]) {
      throw RigidError(fmt::format("revolved: {} is the same as the next one; leave it out (the profile closes itself)",
                                   point_text(profile, i)));
    }
    const Vec2 &before = profile[(i + n - 1) % n], &after = profile[next];
    if (profile[i].x() == 0.0 && before.x() > 0.0 && after.x() > 0.0) {
      throw RigidError(fmt::format("revolved: {} alone is on the axis; give it an edge along r = 0, or r > 0",
                                   point_text(profile, i)));
    }
    const Vec2 in = profile[i] - before, out = after - profile[i];
    if (cross(in, out) == 0.0 && in.dot(out) < 0.0)
      throw RigidError(fmt::format("revolved: the profile turns back on itself at {}", point_text(profile, i)));
  }
}

/// @throws RigidError
void check(const Profile& profile) {
  check_points(profile);
  const std::size_t n = profile.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n == i) continue;  // neighbours share a point
      if (!touch(profile[i], profile[i + 1], profile[j], profile[(j + 1) % n])) continue;
      throw RigidError(fmt::format("revolved: the profile cuts itself: the edge that begins at {} meets the one at {}",
                                   point_text(profile, i), point_text(profile, j)));
    }
  }
}

class RevolvedSurface final : public Surface {
 public:
  RevolvedSurface(Profile profile, bool in_half_plane) : profile_(std::move(profile)), in_half_plane_(in_half_plane) {
    if (twice_area(profile_) < 0.0) std::reverse(profile_.begin(), profile_.end());
    add_edges();
    low_ = high_ = profile_.front();
    for (const Vec2& point : profile_) {
      low_ = low_.cwiseMin(point);
      high_ = high_.cwiseMax(point);
    }
    thickness_ = find_thickness();
  }

  SurfacePoint at(const Vec3& point) const override {
    if (in_half_plane_) {
      const auto [distance, normal] = nearest({point.x(), point.z()});
      return {distance, {normal.x(), 0.0, normal.y()}};
    }
    const double r = std::hypot(point.x(), point.y());
    const auto [distance, normal] = nearest({r, point.z()});
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
      const double angle = 2.0 * kPi * (segment % kSegments) / kSegments;
      return Vec3(p.x() * std::cos(angle), p.x() * std::sin(angle), p.y());
    };
    std::vector<std::array<Vec3, 3>> result;
    for (const Edge& edge : edges_) {
      for (int i = 0; i < kSegments; ++i) {
        const Vec3 from = vertex(edge.from, i), from_next = vertex(edge.from, i + 1);
        const Vec3 to = vertex(edge.to, i), to_next = vertex(edge.to, i + 1);
        if (edge.from.x() > 0.0) result.push_back({from, from_next, to_next});
        if (edge.to.x() > 0.0) result.push_back({from, to_next, to});
      }
    }
    return result;
  }

 private:
  /// An edge off the axis, the body on its left.
  struct Edge {
    Vec2 from, to;
    Vec2 normal;                  ///< outward
    Vec2 from_normal, to_normal;  ///< of its corners: sum of their edges' normals, unit
    double length;
  };

  void add_edges() {
    const std::size_t n = profile_.size();
    const auto on_axis = [&](std::size_t i) { return profile_[i].x() == 0.0 && profile_[(i + 1) % n].x() == 0.0; };
    const auto normal = [&](std::size_t i) {
      const Vec2 along = profile_[(i + 1) % n] - profile_[i];
      return Vec2(Vec2(along.y(), -along.x()).normalized());
    };
    // Between an edge and the axis lies a corner with the edge's mirror image.
    const auto corner = [&](std::size_t first, std::size_t second) {
      const auto mirrored = [](const Vec2& v) { return Vec2(-v.x(), v.y()); };
      const Vec2 one = on_axis(first) ? mirrored(normal(second)) : normal(first);
      const Vec2 two = on_axis(second) ? mirrored(normal(first)) : normal(second);
      return Vec2((one + two).normalized());
    };
    for (std::size_t i = 0; i < n; ++i) {
      if (on_axis(i)) continue;
      const Vec2 &from = profile_[i], &to = profile_[(i + 1) % n];
      edges_.push_back({from, to, normal(i), corner((i + n - 1) % n, i), corner(i, (i + 1) % n), (to - from).norm()});
    }
  }

  /// Signed distance to the polygon, and its gradient, at (r, z).
  std::pair<double, Vec2> nearest(const Vec2& point) const {
    double least = std::numeric_limits<double>::infinity();
    const Edge* edge = nullptr;
    double along = 0.0;
    for (const Edge& e : edges_) {
      const Vec2 arm = point - e.from, direction = (e.to - e.from) / e.length;
      const double t = arm.dot(direction);
      const double squared = t <= 0.0        ? arm.squaredNorm()
                             : t >= e.length ? (point - e.to).squaredNorm()
                                             : std::pow(arm.dot(e.normal), 2);
      if (squared >= least) continue;
      least = squared;
      edge = &e;
      along = t;
    }
    if (along > 0.0 && along < edge->length) return {(point - edge->from).dot(edge->normal), edge->normal};
    const bool at_start = along <= 0.0;
    const Vec2& corner_normal = at_start ? edge->from_normal : edge->to_normal;
    const Vec2 arm = point - (at_start ? edge->from : edge->to);
    const double distance = arm.norm();
    if (distance == 0.0) return {0.0, corner_normal};
    const double side = arm.dot(corner_normal) < 0.0 ? -1.0 : 1.0;
    return {side * distance, side / distance * arm};
  }

  /// How far a ray inwards from a point of the surface goes, through the axis and on, until it leaves through a face
  /// opposite; nothing where that face is not opposite (kOpposed).
  std::optional<double> depth(const Vec2& origin, const Vec2& inwards, const Edge* own) const {
    double least = std::numeric_limits<double>::infinity();
    bool opposed = false;
    for (const Edge& e : edges_) {
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
    for (const Edge& edge : edges_) {
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

  Profile profile_;
  bool in_half_plane_;
  std::vector<Edge> edges_;
  Vec2 low_, high_;
  double thickness_ = 0.0;
};

void require_positive(const char* shape, const char* what, double value) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw RigidError(fmt::format("{}: {} is {:g} m; it must be positive and finite", shape, what, value));
}

}  // namespace

std::unique_ptr<Surface> make_revolved(const Profile& profile) {
  check(profile);
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
