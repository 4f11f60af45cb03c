#include "mpm/rigid/touch_points.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace mpm {
namespace {

constexpr double kSpacings = 24.0;   ///< spacings of points in the length of a body
constexpr double kFlat = 0.99985;    ///< cosine between the normals of faces that are one: 1 degree
constexpr double kSamePlace = 1e-9;  ///< part of the body's size
constexpr double kOnSurface = 0.02;  ///< part of the size by which an edge's points may miss a round face

using PlaceKey = std::tuple<long long, long long, long long>;

/// An edge of drawn faces.
struct DrawnEdge {
  Vec3 from, to;
  Vec3 normals = Vec3::Zero();  ///< sum of those of its faces
  Vec3 first = Vec3::Zero();    ///< normal of the first face
  bool shared = false, sharp = true;
};

class PointList {
 public:
  PointList(const Surface& surface, double size, bool in_plane) : surface_(surface), size_(size), in_plane_(in_plane) {}

  PlaceKey key(const Vec3& place) const {
    const double unit = kSamePlace * size_;
    return {std::llround(place.x() / unit), std::llround(place.y() / unit), std::llround(place.z() / unit)};
  }
  /// Adds a point on the surface, where faces with these normals meet; what a compound hides is left out.
  void add(Vec3 place, Vec3 normals) {
    if (in_plane_) place.y() = normals.y() = 0.0;
    const SurfacePoint found = surface_.at(place);
    if (!(std::abs(found.distance) <= kOnSurface * size_)) return;
    place -= found.distance * found.normal;
    if (in_plane_) place.y() = 0.0;
    const auto [known, is_new] = known_.try_emplace(key(place), list_.size());
    if (is_new) list_.push_back({place, 0.0, Vec3::Zero()});
    list_[known->second].inward -= normals;
  }
  std::vector<TouchPoint> take() {
    for (TouchPoint& point : list_) point.inward.stableNormalize();
    return std::move(list_);
  }

 private:
  const Surface& surface_;
  double size_;
  bool in_plane_;
  std::map<PlaceKey, std::size_t> known_;
  std::vector<TouchPoint> list_;
};

/// Edges whose faces make an angle outwards, or that end a drawn surface.
std::vector<DrawnEdge> sharp_edges(const Surface& surface, const PointList& points) {
  std::map<std::pair<PlaceKey, PlaceKey>, DrawnEdge> edges;
  for (const auto& triangle : surface.triangles()) {
    const Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).stableNormalized();
    for (int e = 0; e < 3; ++e) {
      const Vec3 &from = triangle[e], &to = triangle[(e + 1) % 3], &opposite = triangle[(e + 2) % 3];
      PlaceKey low = points.key(from), high = points.key(to);
      if (high < low) std::swap(low, high);
      DrawnEdge& edge = edges.try_emplace({low, high}, DrawnEdge{from, to}).first->second;
      const bool flat = edge.shared && normal.dot(edge.first) > kFlat;
      const bool outwards = !edge.shared || edge.first.dot(opposite - from) < 0.0;
      edge.sharp = outwards && !flat;
      if (!edge.shared) edge.first = normal;
      edge.normals += normal;
      edge.shared = true;
    }
  }
  std::vector<DrawnEdge> sharp;
  for (const auto& [ends, edge] : edges) {
    if (edge.sharp) sharp.push_back(edge);
  }
  return sharp;
}

/// Diagonal of the drawn surface along the axes in which the body ends.
double drawn_size_of(const Surface& surface) {
  Box drawn;
  for (const auto& triangle : surface.triangles()) {
    for (const Vec3& corner : triangle) drawn.add(corner);
  }
  const Box bounds = surface.bounds();
  Vec3 size = drawn.size();
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(bounds.max[k] - bounds.min[k])) size[k] = 0.0;
  }
  return size.norm();
}

}  // namespace

std::vector<TouchPoint> touch_points(const Surface& surface, bool in_plane) {
  std::vector<TouchPoint> balls = surface.balls();
  if (!balls.empty()) return balls;
  const Box bounds = surface.bounds();
  const auto ends = [&](int axis) { return std::isfinite(bounds.max[axis] - bounds.min[axis]); };
  if (!ends(0) || (!in_plane && !ends(1))) return {};
  const double size = drawn_size_of(surface), spacing = size / kSpacings;
  PointList points(surface, size, in_plane);
  for (const DrawnEdge& edge : sharp_edges(surface, points)) {
    // Corners of a section are edges along y; those that lie in it end what is drawn.
    const Vec3 way = edge.to - edge.from;
    if (in_plane && std::hypot(way.x(), way.z()) > kSamePlace * size) continue;
    const int parts = std::max(1, static_cast<int>(std::ceil(way.norm() / spacing)));
    for (int k = 0; k <= parts; ++k) {
      points.add(edge.from + static_cast<double>(k) / parts * way, edge.normals);
    }
  }
  return points.take();
}

}  // namespace mpm
