// Projection of a prescribed motion or pose of a rigid body onto the axes of the scene's geometry.
#pragma once

#include "mpm/math/geometry_kind.hpp"
#include "mpm/rigid/rigid_body.hpp"

namespace mpm {

/// The components of a body's motion that a geometry has: those along its axes, and rotation about y in a plane.
/// @throws RigidError in an axisymmetric scene for a motion that would take the body off the axis, tilt or spin it.
Twist projected(const Twist& twist, GeometryKind geometry, const RigidBodyDefinition& body);
/// The pose within a geometry; in a plane with the part of the rotation that is about y (swing and twist), so that
/// zeros stay exact zeros. @throws RigidError for a pose that is turned over in a plane, or off the axis or turned in
/// an axisymmetric scene.
Pose projected(const Pose& pose, GeometryKind geometry, const RigidBodyDefinition& body);

}  // namespace mpm
