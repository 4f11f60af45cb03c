// The grid of a definition.
#pragma once

#include "mpm/definition/definition.hpp"
#include "mpm/grid/grid_layout.hpp"

namespace mpm {

/// @throws GridError
GridLayout layout_of(const SimulationDefinition& definition);

}  // namespace mpm
