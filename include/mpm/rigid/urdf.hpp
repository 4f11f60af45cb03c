// The collision geometry of a robot's link as a rigid body, out of a URDF file.
//
// Box, sphere, cylinder and mesh, each at its origin; several of one link become one body (compound.hpp). Joints,
// masses and visuals are ignored. A xacro file must be expanded first.
// Source: the URDF specification, http://wiki.ros.org/urdf/XML/link; the file is read by urdfdom.
#pragma once

#include <memory>
#include <string>

#include "mpm/rigid/surface.hpp"

namespace mpm {

/// Loads a link's geometry, in the link's own frame [m]. `path` may be package://…, file://… or a path; a mesh's may be
/// relative to the file's folder too. `thinnest` [m]: of its meshes, see make_mesh().
/// @throws RigidError with the path when the file is missing or not a URDF, the link does not exist or has no collision
/// geometry, or its sizes or mesh are not those of a solid.
std::unique_ptr<Surface> load_urdf_link(const std::string& path, const std::string& link, double thinnest = 0.0);

}  // namespace mpm
