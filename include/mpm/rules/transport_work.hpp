// Work of transport in a step, found before there is a run: quantities move in stages on the grid, as many as their
// fastest conductor asks for. A slip in a unit makes them millions.
#pragma once

#include <string>
#include <vector>

#include "mpm/definition/definition.hpp"

namespace mpm {

/// Work that the transport of a quantity takes in a step of the mechanics.
struct TransportWork {
  const char* quantity = "";  ///< its key
  std::string material;       ///< in which it spreads fastest; empty where it does not spread
  double diffusivity = 0.0;   ///< there [m^2/s]
  double step = 0.0;          ///< step of the mechanics [s]
  double stages = 1.0;        ///< in it, of all its updates
  std::string cause;          ///< the key that asks for them, its value and what may be wrong with it
};
/// Work of each quantity of the definition. `materials`: names of those that bodies have.
std::vector<TransportWork> transport_work(const SimulationDefinition& definition,
                                          const std::vector<std::string>& materials);

/// One line on the key that makes steps slow, where stages are so many that they are most of the work; else empty.
/// `materials`: names of those that bodies have. @throws DefinitionError where no step would come to an end
std::string transport_warning(const SimulationDefinition& definition, const std::vector<std::string>& materials);

}  // namespace mpm
