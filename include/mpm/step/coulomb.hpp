// Contact of one node with a surface of infinite mass: stick, slide or let go.
//
// Weak: a node is in contact or not, so a surface between two rows of nodes is felt up to a cell early.
// Source: Nairn, GIMP notes (3.12)-(3.20) with the cone limit and the sense of the tangent of method reference 8.3
// (erratum 24); divided here by the nodal mass.
#pragma once

#include "mpm/math/geometry.hpp"
#include "mpm/rigid/rigid_body.hpp"

namespace mpm {

/// Change of the node's velocity. `relative`: velocity of the material minus that of the surface [m/s];
/// `normal`: out of the surface, towards the material.
inline Vec3 contact_velocity_change(const Vec3& relative, const Vec3& normal, const FrictionLaw& law) {
  const double approach = relative.dot(normal);
  if (!(approach < 0.0)) return Vec3::Zero();
  if (law.stick) return -relative;
  const Vec3 tangential = relative - approach * normal;
  const double sliding = tangential.norm();
  const double limit = -law.coefficient * approach;
  const Vec3 normal_change = -approach * normal;
  if (sliding <= limit) return normal_change - tangential;
  return normal_change - tangential * (limit / sliding);
}

}  // namespace mpm
