// The straight way between two openings of a crack's faces: where it leaves an ellipse about the origin, and the work
// of tractions along it. Private to this folder.
#pragma once

#include <algorithm>
#include <cmath>

#include "mpm/crack/traction_law.hpp"

namespace mpm {

struct OpeningPath {
  FaceOpening from, to;

  FaceOpening at(double s) const {
    return {from.normal + s * (to.normal - from.normal), from.shear + s * (to.shear - from.shear)};
  }
  /// Place where it leaves the ellipse with these half axes [m]; `to` lies outside, `from` inside or on it.
  FaceOpening leaves(double normal, double shear) const {
    if (!(normal > 0.0 && shear > 0.0)) return from;
    const double p[2] = {from.normal / normal, from.shear / shear};
    const double d[2] = {(to.normal - from.normal) / normal, (to.shear - from.shear) / shear};
    const double a = d[0] * d[0] + d[1] * d[1], b = p[0] * d[0] + p[1] * d[1];
    const double c = p[0] * p[0] + p[1] * p[1] - 1.0;
    if (c >= 0.0 && b >= 0.0) return from;
    const double root = std::sqrt(std::max(0.0, b * b - a * c));
    return at(std::min(1.0, b > 0.0 ? -c / (b + root) : (root - b) / a));
  }
};

/// Work of tractions that change linearly from a to b while the opening goes from `from` to `to` [J/m^2].
inline double traction_work(const Traction& a, const FaceOpening& from, const Traction& b, const FaceOpening& to) {
  return 0.5 * (a.normal + b.normal) * (to.normal - from.normal) + 0.5 * (a.shear + b.shear) * (to.shear - from.shear);
}

inline Traction traction_of(const std::array<double, 2>& secants, const FaceOpening& opening) {
  return {secants[0] * opening.normal, secants[1] * opening.shear};
}

}  // namespace mpm
