// The grid of a definition.
#pragma once

#include "mpm/grid/grid_layout.hpp"
#include "mpm/simulation/definition.hpp"

namespace mpm {

/// @throws GridError
GridLayout layout_of(const SimulationDefinition& definition);

}  // namespace mpm
