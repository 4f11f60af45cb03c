// Velocity fields of a scene: one for each group of bodies that its bodies name, a second one for a group
// that thin tools divide, and more for one that cracks divide (grid/field_map.hpp). Private to this folder.
#pragma once

#include "mpm/definition/definition.hpp"
#include "mpm/grid/field_map.hpp"
#include "mpm/grid/fields.hpp"
#include "mpm/grid/node_choice.hpp"

namespace mpm {

/// @throws DefinitionError for a body whose field is negative
FieldMap field_map(const SimulationDefinition& definition);

/// The fields with walls, `count` of them, without blocks yet. @throws GridError
Fields make_fields(const SimulationDefinition& definition, int count);

/// Choice for the bodies that cracks divide; null if there are none.
std::unique_ptr<NodeChoice> make_choice(const FieldMap& map, Fields& fields);

}  // namespace mpm
