// What a scene's geometry leaves of a motion or a pose that a rigid body is told.
#pragma once

#include "mpm/math/geometry_kind.hpp"
#include "mpm/rigid/rigid_body.hpp"

namespace mpm {

/// What a geometry keeps of a body's motion: what is along its axes, and rotation about y in a plane, none in a line.
/// @throws RigidError in an axisymmetric scene for a motion that would take the body off the axis, tilt or spin it.
Twist projected(const Twist& twist, GeometryKind geometry, const RigidBodyDefinition& body);
/// The same of a pose; in a plane the part of the rotation that is about y (swing and twist), so that zeros stay exact
/// zeros. @throws RigidError for a pose that is turned over in a plane, or off the axis or turned in axisymmetry.
Pose projected(const Pose& pose, GeometryKind geometry, const RigidBodyDefinition& body);

}  // namespace mpm
