// Particles that come to a set, and go from it, between two steps. Those asleep stay the last ones and change places as
// in permute() (permute.hpp). The set has to be sorted after it.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/particles/particle_set.hpp"

namespace mpm {

/// Puts the particles of another set of the same law behind the last one awake. What `more` does not store is 0; their
/// places at the start are those that they have.
void append_awake(ParticleSet& set, const ParticleSet& more);

/// Removes particles that are awake. `places`: ascending, each once.
void remove_awake(ParticleSet& set, const std::vector<std::uint32_t>& places);

/// Copies all that a particle has, at one place, to another.
void copy_particle(ParticleSet& set, std::size_t from, std::size_t to);

/// Drops the particles from a place on.
void cut_off(ParticleSet& set, std::size_t size);

}  // namespace mpm
