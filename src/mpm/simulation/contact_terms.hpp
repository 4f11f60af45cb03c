// Contact between the deformable bodies of a definition, as the stage that applies it takes it: names of bodies have
// become velocity fields. Before anything is sorted: sets begin to remember where their particles start, where
// displacements are asked for. Private to this room.
#pragma once

#include "mpm/contact/material_contact.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {

/// `sets`: of each body; `map`: their fields. @throws DefinitionError for a pair that names no body, or bodies of one
/// field; for two laws between the same fields.
MaterialContactSettings make_contact_settings(const SimulationDefinition& definition, std::vector<ParticleSet>& sets,
                                              const FieldMap& map, const GridLayout& layout, int threads);

}  // namespace mpm
