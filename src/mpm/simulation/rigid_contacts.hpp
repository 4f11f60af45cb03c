// The laws of contact of every rigid body against every deformable one. Private to this folder.
#pragma once

#include <vector>

#include "mpm/particles/particle_set.hpp"
#include "mpm/simulation/definition.hpp"

namespace mpm {

/// A body's own friction where the scene names no law for the pair; the sets of a body together.
std::vector<ContactLaw> rigid_contact_laws(const SimulationDefinition& definition,
                                           const std::vector<ParticleSet>& sets);

}  // namespace mpm
