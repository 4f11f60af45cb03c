// Loops over the particles of a set that are awake, for what writes to no other particle.
#pragma once

#include "mpm/loop/loop.hpp"
#include "mpm/particles/particle_set.hpp"

namespace mpm {

/// visit(particle)
template <class Visit>
void for_particles(const char* name, const ParticleSet& set, int threads, Visit&& visit) {
  for_all(name, threads, set.awake(), visit);
}

/// pass(first, end, group) for groups of so many particles.
template <class Pass>
void for_particle_groups(const char* name, const ParticleSet& set, int of_group, int threads, Pass&& pass) {
  for_groups(name, threads, set.awake(), of_group, pass);
}

}  // namespace mpm
