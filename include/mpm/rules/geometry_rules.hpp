// Materials, starts, faces and forces that a geometry cannot have, and what can be used instead: one place for scenes
// and for definitions made by hand.
#pragma once

#include <optional>
#include <string>

#include "mpm/definition/definition.hpp"

namespace mpm {

/// Reason why a body of this material cannot be in such a scene, and what can be used instead; empty when it can.
/// @throws MaterialError for constants that no law can have
std::string refused_material(GeometryKind geometry, const MaterialDefinition& material);

/// Warning for a user of this material in such a scene; empty when there is nothing.
std::string material_warning(GeometryKind geometry, const MaterialDefinition& material);

/// Reason why a geometry cannot have a geostatic start, and what can be used instead; empty when it can.
std::string refused_geostatic(GeometryKind geometry);

struct AxisFault {
  std::string key;   ///< key of the scene's section: "grid", "boundaries", "gravity", "bodies"
  std::string text;  ///< fault, and what to write instead
};
/// Reason why a scene cannot have its grid, gravity, faces or bodies about an axis; none when it can, or is not
/// axisymmetric.
std::optional<AxisFault> axis_fault(const SimulationDefinition& definition);

}  // namespace mpm
