// Which velocity fields a scene has: one each that its bodies name, two in their place with thin tools, the second for
// the material on the far side (contact/tool_sides.hpp). Private to this room.
#pragma once

#include "mpm/grid/fields.hpp"
#include "mpm/simulation/definition.hpp"

namespace mpm {

/// Whether some tool is thin, so that field k of a definition is the two fields 2 k and 2 k + 1.
bool any_sides(const SimulationDefinition& definition);

/// The fields with walls, without blocks yet. @throws DefinitionError, GridError
Fields fields_of(const SimulationDefinition& definition);

}  // namespace mpm
