// Motion of a tool in an axisymmetric scene: it may move along its axis, which is the scene's; a ring may also open and
// close, along x. Anything else would end the symmetry, so it is refused. Private to this folder.
#pragma once

#include "mpm/rigid/rigid_body.hpp"

namespace mpm {

/// The twist with what is noise dropped: components below 1e-6 of the twist's size, the faster of the origin and of
/// what turns at the body's farthest corner. What is not finite is returned as it is.
/// @throws RigidError when it would take the body off the axis, tilt or spin it.
Twist axial_twist(const Twist& twist, const RigidBodyDefinition& body);

/// The same of a pose, whose size is the larger of its distance from the origin and the body's reach; of the
/// quaternion 1. @throws RigidError
Pose axial_pose(const Pose& pose, const RigidBodyDefinition& body);

}  // namespace mpm
