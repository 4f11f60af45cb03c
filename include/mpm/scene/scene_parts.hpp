// Parts of a scene that sections, the building of bodies and advice ask for.
#pragma once

#include <vector>

#include "mpm/scene/scene.hpp"

namespace mpm {

/// Material of a deformable body.
const MaterialDefinition& material_of(const BodyDefinition& body, const Scene& scene);
/// Distance between particle centres along an axis [m].
double particle_spacing(const Scene& scene, int axis);
/// World axes of the scene's grid (math/geometry_kind.hpp).
std::vector<int> axes_of(const Scene& scene);
/// Name of a world axis.
const char* axis_name(int axis);
/// "a line", "a planar scene", "a solid scene".
const char* scene_kind(GeometryKind geometry);

}  // namespace mpm
