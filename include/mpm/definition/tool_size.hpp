// Warning of a rigid body that is so large that its unit of length is likely another one than was meant.
#pragma once

#include <string>

#include "mpm/definition/definition.hpp"

namespace mpm {

/// "rigid body 'tool' is 100 m long in a grid of 0.4 m: check its unit (scale)" of a body that is ten times as long as
/// the grid, or three times along every axis; empty of any other, and of one without end.
std::string size_doubt(const RigidBodyDefinition& body, const SimulationDefinition& definition);

}  // namespace mpm
