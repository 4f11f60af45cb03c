// The particles of a definition's bodies as sets. Over several ranks every one of them makes its own particles alone;
// what is said of all of a body's is found together.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mpm/definition/definition.hpp"
#include "mpm/grid/grid_layout.hpp"
#include "mpm/material/law.hpp"
#include "mpm/math/stopped.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/ranks/communicator.hpp"

namespace mpm {

/// Particles of a body on all ranks.
std::uint64_t whole_of(const DeformableBody& body);

/// Leaves this rank's own particles in a definition that has all of them on every rank. Does nothing to one that was
/// built for ranks. Collective, without a word.
void leave_own(SimulationDefinition& definition, const Communicator& ranks, const GridLayout& layout);

/// `first`: id of the body's first particle; `ranks`: null for a process that is alone. Collective. Adds to `warnings`.
/// @throws DefinitionError
ParticleSet make_set(const SimulationDefinition& definition, const DeformableBody& body,
                     const MaterialDefinition& material, const Law& law, const GridLayout& layout, std::uint32_t first,
                     Communicator* ranks, std::vector<std::string>& warnings, StopCheck& check_stop);

/// Mass of a body's particles on all ranks [kg]. Collective.
double total_mass(const ParticleSet& set, const DeformableBody& body, Communicator* ranks);
/// The least mass of a particle on any rank, or of one whose place no surface cuts (`whole`) [kg]. Collective.
double least_mass(const std::vector<ParticleSet>& sets, Communicator* ranks, bool whole = false);

/// Frees what has been read.
void forget_particles(DeformableBody& body);

}  // namespace mpm
