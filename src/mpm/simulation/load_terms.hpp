// The loads of a definition, as the stages that apply them take them: names of bodies have become sets, and particles
// are chosen. Sets that functions with X, Y or Z act on begin to remember where their particles start. Before anything
// is sorted: particles are known by their places. Private to this room.
#pragma once

#include <vector>

#include "mpm/mechanics/face_tractions.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {

/// Body forces and forces on particles. @throws DefinitionError
std::vector<ParticleLoadTerm> make_load_terms(const SimulationDefinition& definition, std::vector<ParticleSet>& sets);

/// Tractions. @throws DefinitionError
std::vector<TractionTerm> make_traction_terms(const SimulationDefinition& definition, std::vector<ParticleSet>& sets,
                                              const GridLayout& layout);

}  // namespace mpm
