// What transport costs in a step, before there is a run: quantities move in stages on the grid, as many as their
// fastest conductor asks for. A slip in a unit makes them millions.
#pragma once

#include <string>
#include <vector>

#include "mpm/simulation/definition.hpp"

namespace mpm {

/// One line on the key that makes steps slow, where stages are so many that they cost far more than the mechanics;
/// else empty. `materials`: names of those that bodies have. @throws DefinitionError where no step would come to an end
std::string transport_warning(const SimulationDefinition& definition, const std::vector<std::string>& materials);

}  // namespace mpm
