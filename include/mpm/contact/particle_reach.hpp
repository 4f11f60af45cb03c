// Reach of a particle from its centre towards a surface: the ellipsoid inscribed in its box, deformed with it.
// Along the box's axes it is as long as the box, and it turns with the material; a lattice of particles reaches its own
// flat side exactly in any orientation. For material that flows (a law with history) the deformed box has no meaning:
// its particles reach as far as a ball of their present volume does, and never farther than at the start, even where
// they have parted.
#pragma once

#include <algorithm>
#include <cmath>

#include "mpm/grid/grid_layout.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/particles/particle_set.hpp"

namespace mpm {

/// Factor by which the particle's section along the grid's axes (in a solid its volume) has changed since the start.
template <class Geometry>
double stretch_of_section(const ParticleSet& set, int p) {
  const auto f = Geometry::load_matrix(set.f, p);
  if constexpr (Geometry::kDim == 2) return f.xx * f.zz - f.xz * f.zx;
  if constexpr (Geometry::kDim != 2) return determinant(f);
}

/// Reach along `normal` [m], a unit vector along the grid's axes in world components.
template <class Geometry>
double particle_reach(const ParticleSet& set, const GridLayout& layout, int p, const Vec3& normal) {
  constexpr int kDim = Geometry::kDim;
  const auto f = Geometry::load_matrix(set.f, p);
  double squared = 0.0, rest = 0.0;
  const auto along = [&](int k) {  // (F^T n)_k
    if constexpr (kDim == 1) return f.xx * normal.x();
    if constexpr (kDim == 2)
      return k == 0 ? f.xx * normal.x() + f.zx * normal.z() : f.xz * normal.x() + f.zz * normal.z();
    if constexpr (kDim == 3) {
      return k == 0   ? f.xx * normal.x() + f.yx * normal.y() + f.zx * normal.z()
             : k == 1 ? f.xy * normal.x() + f.yy * normal.y() + f.zy * normal.z()
                      : f.xz * normal.x() + f.yz * normal.y() + f.zz * normal.z();
    }
  };
  for (int k = 0; k < kDim; ++k) {
    const double half = set.half[k] * layout.cell(k), n = normal[layout.axis(k)], part = half * along(k);
    squared += part * part;
    rest += half * half * n * n;
  }
  const double j = std::max(stretch_of_section<Geometry>(set, p), 0.0);
  if (!set.history.empty()) return std::sqrt(rest) * std::min(std::pow(j, 1.0 / kDim), 1.0);
  return std::sqrt(squared);
}

}  // namespace mpm
