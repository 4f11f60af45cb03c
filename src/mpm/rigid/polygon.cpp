// A closed polygon in planar scenes, without end along y: a wheel with lugs, a bucket's section.
//
// Weak: every edge is looked at (outline.hpp). Its thickness is the shortest ray inwards from the middle of an edge.
#include <algorithm>
#include <cmath>
#include <limits>

#include "ear_clipping.hpp"
#include "mpm/rigid/surface.hpp"
#include "outline.hpp"

namespace mpm {

namespace {

class PolygonSurface final : public Surface {
 public:
  PolygonSurface(const Profile& profile, double drawn) : outline_(profile, false), drawn_(drawn) {
    thickness_ = find_thickness();
  }

  SurfacePoint at(const Vec3& point) const override {
    const auto [distance, normal] = outline_.nearest({point.x(), point.z()});
    return {distance, {normal.x(), 0.0, normal.y()}};
  }

  bool within(const Vec3& point, double band, SurfacePoint& result) const override {
    const Vec2 &low = outline_.low(), &high = outline_.high();
    if (point.z() - high.y() > band || low.y() - point.z() > band || point.x() - high.x() > band ||
        low.x() - point.x() > band)
      return false;
    const SurfacePoint found = at(point);
    if (found.distance > band) return false;
    result = found;
    return true;
  }

  Box bounds() const override {
    const double endless = std::numeric_limits<double>::infinity();
    return {{outline_.low().x(), -endless, outline_.low().y()}, {outline_.high().x(), endless, outline_.high().y()}};
  }

  double thickness() const override { return thickness_; }

  std::vector<std::array<Vec3, 3>> triangles() const override {
    const auto vertex = [&](const Vec2& p, double side) { return Vec3(p.x(), 0.5 * side * drawn_, p.y()); };
    std::vector<std::array<Vec3, 3>> result;
    for (const OutlineEdge& edge : outline_.edges()) {
      const Vec3 a = vertex(edge.from, -1.0), b = vertex(edge.to, -1.0);
      const Vec3 c = vertex(edge.to, 1.0), d = vertex(edge.from, 1.0);
      result.push_back({a, c, b});
      result.push_back({a, d, c});
    }
    for (const auto& [a, b, c] : cut_into_triangles(outline_.profile())) {  // the ends
      result.push_back({vertex(a, -1.0), vertex(b, -1.0), vertex(c, -1.0)});
      result.push_back({vertex(a, 1.0), vertex(c, 1.0), vertex(b, 1.0)});
    }
    return result;
  }

  // Triangles from the origin to every edge, with their signs.
  std::optional<SolidMoments> moments(double across) const override {
    double area = 0.0;
    Vec2 first = Vec2::Zero();
    Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
    for (const OutlineEdge& edge : outline_.edges()) {
      const double twice = edge.from.x() * edge.to.y() - edge.from.y() * edge.to.x();
      const Vec2 sum = edge.from + edge.to;
      area += twice / 2.0;
      first += twice / 6.0 * sum;
      second +=
          twice / 24.0 * (sum * sum.transpose() + edge.from * edge.from.transpose() + edge.to * edge.to.transpose());
    }
    const Vec2 centre = first / area;
    second -= area * centre * centre.transpose();
    SolidMoments moments;
    moments.volume = area * across;
    moments.centre = {centre.x(), 0.0, centre.y()};
    moments.second(0, 0) = across * second(0, 0);
    moments.second(2, 2) = across * second(1, 1);
    moments.second(0, 2) = moments.second(2, 0) = across * second(0, 1);
    moments.second(1, 1) = moments.volume * across * across / 12.0;
    return moments;
  }

 private:
  double find_thickness() const {
    double least = std::numeric_limits<double>::infinity();
    for (const OutlineEdge& own : outline_.edges()) {
      const Vec2 origin = 0.5 * (own.from + own.to), inwards = -own.normal;
      for (const OutlineEdge& e : outline_.edges()) {
        const double leaving = inwards.dot(e.normal);
        if (&e == &own || leaving <= 0.0) continue;
        const double length = (e.from - origin).dot(e.normal) / leaving;
        const Vec2 hit = origin + length * inwards;
        if (length > 0.0 && (hit - e.from).dot(hit - e.to) <= 0.0) least = std::min(least, length);
      }
    }
    return least;
  }

  Outline outline_;
  double drawn_;
  double thickness_ = 0.0;
};

}  // namespace

std::unique_ptr<Surface> make_polygon(const Profile& profile, double drawn) {
  check_outline(profile, "polygon", false);
  return std::make_unique<PolygonSurface>(profile, drawn);
}

}  // namespace mpm
