// What a geometry cannot have, and what can be used instead: said once, for scenes and for definitions made by hand.
#pragma once

#include <string>

#include "mpm/simulation/definition.hpp"

namespace mpm {

/// Why a body of this material cannot be in such a scene, and what can be used instead; empty when it can.
/// @throws MaterialError for constants that no law can have
std::string refused_material(GeometryKind geometry, const MaterialDefinition& material);

/// The same of a geostatic start.
std::string refused_geostatic(GeometryKind geometry);

/// Why a scene cannot have its grid, gravity or bodies about an axis; empty when it can, or is not axisymmetric.
std::string axis_fault(const SimulationDefinition& definition);

}  // namespace mpm
