// Volume, centre and second moments of a solid of uniform density, for the mass and inertia of a free body. Exact for
// boxes, spheres, cylinders, capsules and meshes of triangles.
#pragma once

#include "mpm/math/geometry.hpp"

namespace mpm {

struct SolidMoments {
  double volume = 0.0;         ///< [m^3]
  Vec3 centre = Vec3::Zero();  ///< body axes [m]
  Mat3 second = Mat3::Zero();  ///< integral of (x - centre)(x - centre)^T over the volume [m^5]

  /// Inertia over density about the centre, body axes [m^5].
  Mat3 inertia() const { return second.trace() * Mat3::Identity() - second; }
};

/// Moments of a body that is symmetric about the origin along each axis: its volume and the integrals of x^2, y^2, z^2.
inline SolidMoments centred_moments(double volume, const Vec3& squares) {
  return {volume, Vec3::Zero(), squares.asDiagonal()};
}

}  // namespace mpm
