// The point of a triangle that is nearest to another point: what meshes and height fields measure distance by.
#pragma once

#include <limits>

#include "mpm/math/geometry.hpp"

namespace mpm {

/// Part of a triangle that is nearest to a point: corners 0-2, edges 3-5 (edge 3 + i from corner i), the face 6.
enum : int { kCorner = 0, kEdge = 3, kFace = 6 };

struct Triangle {
  Vec3 a, ab, ac;
  double ab2, ac2, abc;  ///< ab.ab, ac.ac, ab.ac
  int index;             ///< in the mesh

  Triangle() = default;
  Triangle(const Vec3& a, const Vec3& b, const Vec3& c, int index)
      : a(a), ab(b - a), ac(c - a), ab2(ab.squaredNorm()), ac2(ac.squaredNorm()), abc(ab.dot(ac)), index(index) {}
};

struct Nearest {
  double squared = std::numeric_limits<double>::infinity();
  Vec3 point = Vec3::Zero();
  int triangle = -1;
  int feature = kFace;
};

/// Takes the triangle's nearest point to p where it is nearer than the best so far, or as near in a triangle of lower
/// index, so that the order in which triangles are looked at does not matter. By the Voronoi regions of its corners and
/// edges: Ericson (2005), Real-Time Collision Detection, section 5.1.5.
inline void nearest_of(const Triangle& t, const Vec3& p, Nearest& best) {
  const Vec3 ap = p - t.a;
  const double d1 = t.ab.dot(ap), d2 = t.ac.dot(ap);
  const double d3 = d1 - t.ab2, d4 = d2 - t.abc;  // ab.bp, ac.bp
  const double d5 = d1 - t.abc, d6 = d2 - t.ac2;  // ab.cp, ac.cp
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  double v = 0.0, w = 0.0;
  int feature = kFace;
  if (d1 <= 0.0 && d2 <= 0.0) {
    feature = kCorner;
  } else if (d3 >= 0.0 && d4 <= d3) {
    feature = kCorner + 1, v = 1.0;
  } else if (d6 >= 0.0 && d5 <= d6) {
    feature = kCorner + 2, w = 1.0;
  } else if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    feature = kEdge, v = d1 / (d1 - d3);
  } else if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    feature = kEdge + 2, w = d2 / (d2 - d6);
  } else if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
    feature = kEdge + 1, w = (d4 - d3) / ((d4 - d3) + (d5 - d6)), v = 1.0 - w;
  } else {
    const double sum = va + vb + vc;
    v = vb / sum, w = vc / sum;
  }
  const Vec3 offset = v * t.ab + w * t.ac;
  const double squared = (ap - offset).squaredNorm();
  if (squared < best.squared || (squared == best.squared && t.index < best.triangle)) {
    best = {squared, t.a + offset, t.index, feature};
  }
}

}  // namespace mpm
