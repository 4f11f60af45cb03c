// The rules on which motion, kind of contact, laws and geometry go together for a rigid body, in one place. They are
// checked when a Simulation is put together, so they hold for definitions made by hand too. Rules on a body's position
// or shape are checked where these are known (periodic faces in modules/rigid_motion.cpp, the filling with particles
// in contact/rigid_particles.cpp).
#pragma once

#include <string>

#include "mpm/definition/definition.hpp"

namespace mpm {

/// The first rule that `body`, a rigid body of the definition, breaks, and what to write instead; empty when it breaks
/// none. Velocities that the geometry does not have must have been removed before.
std::string rigid_fault(const SimulationDefinition& definition, const RigidBodyDefinition& body);

}  // namespace mpm
