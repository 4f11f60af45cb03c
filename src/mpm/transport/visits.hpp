// Sums over particles, and vectors at them, that the passes of transport share. Private to this folder.
#pragma once

#include <numeric>
#include <vector>

#include "mpm/grid/nodal_fields.hpp"
#include "mpm/math/tensor.hpp"
#include "mpm/particles/for_particles.hpp"
#include "mpm/transport/local_gain.hpp"

namespace mpm {

/// `before` and what pass(first, last, sum) adds to the sum of each group of a set's particles, one after another: the
/// same bits for any number of threads. `sums`: memory for them. `name`: of the loop.
template <class Pass>
double sum_groups(const char* name, const ParticleSet& set, int threads, std::vector<double>& sums, double before,
                  Pass&& pass) {
  sums.assign((set.awake() + kGainGroup - 1) / kGainGroup, 0.0);
  for_particle_groups(name, set, kGainGroup, threads,
                      [&](int first, int last, int group) { pass(first, last, sums[group]); });
  return std::accumulate(sums.begin(), sums.end(), before);
}

/// World position of a particle [m]; 0 along axes that the grid does not have.
inline Vec3 place_of(const ParticleSet& set, const GridLayout& layout, int p) {
  Vec3 place = Vec3::Zero();
  for (int k = 0; k < layout.dim(); ++k) place[layout.axis(k)] = set.x[k][p];
  return place;
}

inline Vec3 times(const Symmetric3<double>& k, const Vec3& v) {
  return {k.xx * v.x() + k.xy * v.y() + k.xz * v.z(), k.xy * v.x() + k.yy * v.y() + k.yz * v.z(),
          k.xz * v.x() + k.yz * v.y() + k.zz * v.z()};
}

}  // namespace mpm
