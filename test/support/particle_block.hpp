// Particles of a block, for tests that write a body by hand.
#pragma once

#include <array>
#include <vector>

#include "mpm/math/geometry.hpp"
#include "mpm/math/geometry_kind.hpp"

/// Centres [m] of counts[0] x counts[1] x counts[2] particles, `spacing` [m] apart, whose block has its lower corner at
/// `low` [m]; z runs fastest. Along an axis that the geometry lacks there is one particle, at 0.
inline std::vector<mpm::Vec3> particle_block(mpm::GeometryKind geometry, const mpm::Vec3& low,
                                             const std::array<int, 3>& counts, double spacing) {
  const bool has_y = geometry == mpm::GeometryKind::solid, has_z = geometry != mpm::GeometryKind::line;
  std::vector<mpm::Vec3> centres;
  for (int i = 0; i < counts[0]; ++i) {
    for (int j = 0; j < (has_y ? counts[1] : 1); ++j) {
      for (int k = 0; k < (has_z ? counts[2] : 1); ++k) {
        const mpm::Vec3 x = low + spacing * mpm::Vec3(i + 0.5, j + 0.5, k + 0.5);
        centres.emplace_back(x.x(), has_y ? x.y() : 0.0, has_z ? x.z() : 0.0);
      }
    }
  }
  return centres;
}
