// Start of particles: under a stress, at a temperature, or as soil at rest.
#pragma once

#include <string>
#include <vector>

#include "mpm/definition/definition.hpp"
#include "mpm/material/initial_state.hpp"
#include "mpm/math/stopped.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/ranks/communicator.hpp"

namespace mpm {

/// Deformation gradient, stress, history and mass of a set whose places are known, as its body asks for. Adds to
/// `warnings`. `ranks`: null for a process that is alone. Collective. @throws DefinitionError naming the body and the
/// particle's place.
void start_particles(ParticleSet& set, const DeformableBody& body, const MaterialDefinition& material,
                     GeometryKind geometry, Communicator* ranks, std::vector<std::string>& warnings,
                     StopCheck& check_stop);

/// Gives the bodies that start geostatic the stress of the weight above them: vertical from the columns of particles
/// over each particle down to its centre, whatever geostatic bodies they belong to, horizontal by k0. A gap in a column
/// carries nothing, and nor do bodies whose columns are not the same: adds to `warnings` where these lie on each other,
/// for settling alone finds that weight. `ranks`: null for a process that is alone. Collective. @throws DefinitionError
void add_geostatic_stress(SimulationDefinition& definition, Communicator* ranks, std::vector<std::string>& warnings);

}  // namespace mpm
