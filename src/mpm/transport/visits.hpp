// Loops over particles and nodes that the passes of transport share. Private to this folder.
#pragma once

#include <algorithm>

#include "mpm/grid/nodal_fields.hpp"
#include "mpm/math/tensor.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/transport/local_gain.hpp"

namespace mpm {

/// pass(first, last, number of the group) for groups of particles.
template <class Pass>
void each_group(int particles, int threads, Pass&& pass) {
  const int groups = (particles + kGainGroup - 1) / kGainGroup;
#pragma omp parallel for schedule(static) num_threads(threads)
  for (int g = 0; g < groups; ++g) pass(g * kGainGroup, std::min(particles, (g + 1) * kGainGroup), g);
}

/// visit(block, node)
template <class Visit>
void each_node(const Grid& grid, int threads, Visit&& visit) {
  const int nodes = grid.layout.nodes_per_block();
#pragma omp parallel for schedule(static) num_threads(threads)
  for (int b = 0; b < grid.blocks.size(); ++b) {
    for (int n = 0; n < nodes; ++n) visit(b, n);
  }
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
