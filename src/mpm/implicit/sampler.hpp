// Parts shared by the points on flat outlines and those on faces in space: the drawn triangles, and what is asked
// about places on them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "mpm/implicit/surface_samples.hpp"
#include "mpm/math/constants.hpp"
#include "mpm/rigid/mesh_topology.hpp"

namespace mpm {

inline const double kSmooth = std::cos(kPi / 6.0);  // faces that turn less are one
inline constexpr double kNarrow = 6.0;              // spacings
inline constexpr double kProbe = 0.5;               // spacings: how far before an edge the surface is looked at
inline constexpr double kSameFace = 0.5;            // cosine between normals of a face as drawn and as it is
// Points at the border of two counts fall on the same side whatever the rounding.
inline constexpr double kRound = 1e-9;
// Part of the spacing: far above the rounding of distances, and too little to matter for contact.
inline constexpr double kHidden = 1e-6;

using Corners = std::array<Vec3, 3>;
using Samples = std::vector<SurfaceSample>;

inline int parts_of(double length, double spacing) {
  return std::max(1, static_cast<int>(std::lround(length / spacing)));
}

inline double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// The surface and what is asked about places on it.
class Sampler {
 public:
  Sampler(const Surface& surface, const SampleRules& rules) : surface_(surface), rules_(rules) {}

  const SampleRules& rules() const { return rules_; }

  /// True if a place of the drawn surface is inside the body, other than by the depth of a chord below its arc. Above
  /// the chord its own arc is the nearest, but beside another part; there the place counts that the arc has below it.
  bool hidden(const Vec3& place, const Vec3& normal, double depth) const {
    const double little = kHidden * rules_.spacing;
    const SurfacePoint above = surface_.at(place + (depth + little) * normal);
    if (above.distance <= 0.0) return true;
    if (above.normal.dot(normal) >= kSameFace) return false;
    const SurfacePoint here = surface_.at(place);
    if (here.normal.dot(normal) < kSameFace) return true;
    return surface_.at(place - here.distance * here.normal).distance < -little;
  }

  /// True if two faces end where they meet. Of an endless body drawn with an end one goes on, and an edge inside
  /// another part is none: only before an edge of the surface the nearest point lies across both faces.
  bool is_edge(const Vec3& place, const Vec3& normal, const Vec3& other) const {
    const Vec3 across = (normal + other).normalized();
    const SurfacePoint found = surface_.at(place + kProbe * rules_.spacing * across);
    return found.distance > 0.0 && angle_between(found.normal, across) < 0.5 * angle_between(normal, across);
  }

  /// Moves a place near the drawn surface to the exact one. Near an edge the place may be deeper below its own face
  /// than below the other one; seen from outside its own is the nearest.
  SurfaceSample settled(const Vec3& place, const Vec3& normal, double area) const {
    for (const double lift : {0.0, 0.1, 0.5}) {
      SurfaceSample sample{place + lift * rules_.spacing * normal, normal, area};
      for (int step = 0; step < 3; ++step) {
        const SurfacePoint found = surface_.at(sample.place);
        if (found.normal.dot(normal) < kSameFace) break;
        sample.normal = found.normal;
        if (step == 2) return sample;
        sample.place -= found.distance * found.normal;
      }
    }
    return {place, normal, area};
  }

 private:
  const Surface& surface_;
  SampleRules rules_;
};

/// The drawn triangles with area.
struct Faces {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
  std::vector<Vec3> normals;
  std::vector<double> areas;

  explicit Faces(const Surface& surface) {
    TriangleMesh loose;
    for (const Corners& corners : surface.triangles()) {
      const int first = static_cast<int>(loose.vertices.size());
      loose.vertices.insert(loose.vertices.end(), corners.begin(), corners.end());
      loose.triangles.push_back({first, first + 1, first + 2});
    }
    TriangleMesh mesh = join_equal_vertices(loose);
    vertices = std::move(mesh.vertices);
    for (const auto& triangle : mesh.triangles) {
      const Vec3 &a = vertices[triangle[0]], &b = vertices[triangle[1]], &c = vertices[triangle[2]];
      const Vec3 twice = (b - a).cross(c - a);
      if (!(twice.norm() > 0.0)) continue;
      triangles.push_back(triangle);
      normals.push_back(twice.normalized());
      areas.push_back(0.5 * twice.norm());
    }
  }

  Corners corners(int t) const {
    return {vertices[triangles[t][0]], vertices[triangles[t][1]], vertices[triangles[t][2]]};
  }
};

}  // namespace mpm
