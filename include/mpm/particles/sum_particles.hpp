// Sums over all particles awake, grouped so that the result does not depend on the number of threads.
#pragma once

#include <vector>

#include "mpm/loop/loop.hpp"
#include "mpm/particles/particle_set.hpp"

namespace mpm {

/// Sum of `term(set, index)`, which is 0 for particles at rest. `name`: of the loop.
template <class Value, class Term>
Value sum_particles(const char* name, const std::vector<ParticleSet>& sets, int threads, Value zero, Term&& term) {
  constexpr int kGroup = 4096;
  Value total = zero;
  for (const ParticleSet& set : sets) {
    std::vector<Value> partial((set.awake() + kGroup - 1) / kGroup, zero);
    for_groups(name, threads, set.awake(), kGroup, [&](int first, int end, int group) {
      for (int p = first; p < end; ++p) partial[group] += term(set, p);
    });
    for (const Value& value : partial) total += value;
  }
  return total;
}

/// [J]; what is asleep has none.
inline double kinetic_energy(const std::vector<ParticleSet>& sets, int threads) {
  return sum_particles("particles: kinetic energy", sets, threads, 0.0, [](const ParticleSet& set, int p) {
    double squared = 0.0;
    for (const ParticleScalar& v : set.v) squared += v[p] * v[p];
    return 0.5 * set.mass_of(p) * squared;
  });
}

}  // namespace mpm
