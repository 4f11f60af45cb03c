// What goes together with a rigid body: its motion, its kind of contact, its laws and the geometry. This is the one
// place that knows. A Simulation asks when it is put together, so that a definition made by hand is held to the same.
// What depends on where a body is, or on its shape, is checked where that is known (periodic faces in
// simulation/rigid_motion.cpp, the filling with particles in contact/rigid_particles.cpp).
#pragma once

#include <string>

#include "mpm/simulation/definition.hpp"

namespace mpm {

/// The first rule that `body`, one of the definition's, breaks, and what to write instead; empty when it breaks none.
/// Velocities that the geometry lacks are expected to be taken out already.
std::string rigid_fault(const SimulationDefinition& definition, const RigidBodyDefinition& body);

}  // namespace mpm
