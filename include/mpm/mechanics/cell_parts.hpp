// Parts of the cells that cracks cut, for what is averaged over a cell: each part has a mean of its own.
#pragma once

#include <array>

#include "mpm/math/geometry.hpp"
#include "mpm/particles/particle_set.hpp"

namespace mpm {

class CellParts {
 public:
  virtual ~CellParts() = default;

  /// Number of parts that a cell may have, at least 1.
  virtual int most() const = 0;
  /// Says in which block the next particles lie.
  virtual void look_at(const std::array<int, 3>& block) = 0;
  /// The part, from 0, of a cell in which a particle of a set lies. `cell`: number of the cell along each axis, from
  /// -1, counted from the first of the block; `place`: of the particle [m].
  virtual int part_of(const ParticleSet& set, const std::array<int, 3>& cell, const Vec2& place) const = 0;
};

}  // namespace mpm
