// Rules of the values that implicit steps take, beside the features that they do not go together with
// (feature_rules.hpp). Asked when a scene is read, when a Simulation is put together, and by the choice of the method.
#pragma once

#include <optional>

#include "mpm/rules/method_rules.hpp"

namespace mpm {

inline constexpr int kMostImplicitSweeps = 1000;  ///< that a scene may ask for

/// The first thing in a scene that takes implicit steps which cannot take them, by its key and with what to write
/// instead; none when it can, or its steps are explicit. Of a scene with explicit steps: what only implicit ones have.
std::optional<MethodFault> implicit_fault(const SimulationDefinition& definition);

}  // namespace mpm
