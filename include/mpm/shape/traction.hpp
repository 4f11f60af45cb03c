// Traction on a face of a particle's domain: an edge in the plane, an end in a line. A traction T, the same all over
// the face in a step, gives node i
//
//   f_i = T sum_a A_a N_i(x_a),
//
// the sum over the face's corners: N_i is replaced by its linear interpolation along the edges, as in CPDI, and the
// parts A_a of the face's area are the integrals of those linear functions. In axisymmetry a face is a ring and the
// integrand has a factor 2 pi r, so the outer corner of an edge has the larger part.
//
// Weak: the sum equals the integral over the true hat functions only where the face crosses no grid line; the total
// force is always T times the area. The area is that of the domain passed in: with a box that keeps its size the
// traction is a force per initial area. Source: Nairn & Guilkey (2015) eq. (40)-(55), checklist; method reference 4.1
// to 4.4 (solid faces and following loads are derived there). Their forces are per radian, these for the whole ring.
#pragma once

#include <array>
#include <cmath>

#include "mpm/math/constants.hpp"
#include "mpm/math/geometry_kind.hpp"

namespace mpm {

/// A particle's domain at its position, in grid axes: the points centre + s_0 d_0 + s_1 d_1 + ... with s_k in [-1, 1].
/// Half vectors as in shape/particle_domain.hpp.
struct PlacedDomain {
  using Vector = std::array<double, 3>;
  int dim = 0;
  Vector center{};            ///< [m]
  std::array<Vector, 3> d{};  ///< half vectors; the first `dim` are used [m]
};

/// The face at one end of a half vector. The papers' edges 1, 2, 3, 4 are z_min, x_max, z_max, x_min.
struct DomainFace {
  int axis = 0;  ///< grid axis whose half vector ends there
  bool upper = false;
  double side() const { return upper ? 1.0 : -1.0; }
};

/// Geometry of a face, as a traction uses it.
struct FaceParts {
  struct Corner {
    PlacedDomain::Vector at{};  ///< [m]
    double area = 0.0;          ///< its part A_a of the face's area [m^2]
  };
  int corners = 0;
  std::array<Corner, 4> corner;    ///< in the order in which the side along the lowest axis changes fastest
  double area = 0.0;               ///< area of the whole face [m^2]
  PlacedDomain::Vector middle{};   ///< [m]
  PlacedDomain::Vector outward{};  ///< unit normal
  /// Unit vectors along the half vectors that span the face, in the order of axes: none in a line, one in a plane.
  std::array<PlacedDomain::Vector, 2> along{};
};

namespace traction {

using Vector = PlacedDomain::Vector;

inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vector& v) { return std::hypot(v[0], v[1], v[2]); }
inline Vector unit(const Vector& v, double sign = 1.0) {
  const double scale = sign / length(v);
  return {scale * v[0], scale * v[1], scale * v[2]};
}

}  // namespace traction

/// Corners, area and directions of a face. `across`: the particle's extent beyond the grid's axes, that is thickness
/// [m] in a plane or area [m^2] in a line; not used in axisymmetry (whole rings) and in a solid.
inline FaceParts face_parts(GeometryKind geometry, const PlacedDomain& domain, DomainFace face, double across) {
  using traction::Vector;
  const double side = face.side();
  FaceParts parts;
  for (int c = 0; c < domain.dim; ++c) parts.middle[c] = domain.center[c] + side * domain.d[face.axis][c];
  if (domain.dim == 1) {
    parts.corners = 1;
    parts.corner[0] = {parts.middle, across};
    parts.area = across;
    parts.outward[0] = side;
    return parts;
  }
  const int a = face.axis == 0 ? 1 : 0, b = 3 - face.axis - a;  // half vectors that span the face; b in a solid
  const Vector &da = domain.d[a], &db = domain.d[b];
  parts.along[0] = traction::unit(da);
  if (domain.dim == 2) {
    parts.corners = 2;
    const double edge = traction::length(da);
    const double mean = axisymmetric(geometry) ? kTurn * parts.middle[0] : across;
    const double slope = axisymmetric(geometry) ? kTurn * da[0] / 3.0 : 0.0;
    for (int i = 0; i < 2; ++i) {
      const double end = 2.0 * i - 1.0;
      for (int c = 0; c < 2; ++c) parts.corner[i].at[c] = parts.middle[c] + end * da[c];
      parts.corner[i].area = edge * (mean + end * slope);
    }
    parts.area = 2.0 * edge * mean;
    parts.outward = traction::unit({da[1], -da[0], 0.0}, face.axis == 0 ? side : -side);
    return parts;
  }
  parts.corners = 4;
  const Vector normal = traction::cross(domain.d[(face.axis + 1) % 3], domain.d[(face.axis + 2) % 3]);
  const double part = traction::length(normal);
  for (int i = 0; i < 4; ++i) {
    for (int c = 0; c < 3; ++c) {
      parts.corner[i].at[c] = parts.middle[c] + (i % 2 == 0 ? -da[c] : da[c]) + (i < 2 ? -db[c] : db[c]);
    }
    parts.corner[i].area = part;
  }
  parts.area = 4.0 * part;
  parts.outward = traction::unit(normal, side);
  parts.along[1] = traction::unit(db);
  return parts;
}

/// Cuts a box in axisymmetry off at r = 0 (Nairn & Guilkey (2015), after eq. (48)).
inline void truncate_at_axis(PlacedDomain& box) {
  double &r = box.center[0], &half = box.d[0][0];
  if (r < half) r = half = 0.5 * (r + half);
}

/// Shrinks a deformed domain in axisymmetry as a whole until no corner is at r < 0 (method reference 3.4 with erratum
/// 14: by |d_1r| + |d_2r|). `along_radius`: shrinks along the radius alone, as a box that stretches needs
/// (ugimp_stretch).
inline void shrink_to_axis(PlacedDomain& domain, bool along_radius = false) {
  const double reach = std::abs(domain.d[0][0]) + std::abs(domain.d[1][0]), r = domain.center[0];
  if (r >= reach) return;
  for (int k = 0; k < 2; ++k) {
    for (int c = 0; c < (along_radius ? 1 : 2); ++c) domain.d[k][c] *= r / reach;
  }
}

}  // namespace mpm
