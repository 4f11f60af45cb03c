// Vectors at particles that the passes of transport share. Private to this folder.
#pragma once

#include "mpm/grid/nodal_fields.hpp"
#include "mpm/math/tensor.hpp"
#include "mpm/particles/particle_set.hpp"

namespace mpm {

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
