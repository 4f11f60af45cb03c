// Sums over all particles awake, grouped so that the result does not depend on the number of threads.
#pragma once

#include <algorithm>
#include <vector>

#include "mpm/particles/particle_set.hpp"

namespace mpm {

/// Sum of `term(set, index)`, which is 0 for particles at rest.
template <class Value, class Term>
Value sum_particles(const std::vector<ParticleSet>& sets, int threads, Value zero, Term&& term) {
  constexpr int kGroup = 4096;
  Value total = zero;
  for (const ParticleSet& set : sets) {
    const int groups = (set.awake() + kGroup - 1) / kGroup;
    std::vector<Value> partial(groups, zero);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int g = 0; g < groups; ++g) {
      const int end = std::min(set.awake(), (g + 1) * kGroup);
      for (int p = g * kGroup; p < end; ++p) partial[g] += term(set, p);
    }
    for (const Value& value : partial) total += value;
  }
  return total;
}

/// [J]; what is asleep has none.
inline double kinetic_energy(const std::vector<ParticleSet>& sets, int threads) {
  return sum_particles(sets, threads, 0.0, [](const ParticleSet& set, int p) {
    double squared = 0.0;
    for (const ParticleScalar& v : set.v) squared += v[p] * v[p];
    return 0.5 * set.mass_of(p) * squared;
  });
}

}  // namespace mpm
