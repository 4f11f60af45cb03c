// A height map of the ground that has been put away: for the area of each node its mass, which is a height at the
// initial density. Made again, it is stacked up from what is there already, as level as whole particles allow; what
// remains, less than half a particle of a node's area, stays in the map, so that mass is neither lost nor won.
//
// Weak: the shape of the surface below the size of a node's area, swelling, stress and history are lost.
#pragma once

#include <array>
#include <map>

#include "mpm/bed/bed_columns.hpp"
#include "mpm/bed/bed_definition.hpp"
#include "mpm/math/state_archive.hpp"

namespace mpm {

class KeptGround {
 public:
  /// Both outlive it. `ceiling`: no particle is stacked above it [m].
  KeptGround(const BedColumns& columns, const GroundSource& source, double ceiling)
      : columns_(columns), source_(source), ceiling_(ceiling) {}

  /// Adds mass [kg] at a place of a column.
  void keep(int column, const Vec3& place, double mass) { masses_[column][columns_.node_of(place)] += mass; }
  /// Takes out of the map what whole particles of that mass [kg] can be made of in a column, and stacks them on those
  /// of `ground` from the first on that is the column's own.
  void stack(int column, double particle_mass, std::size_t first, GroundParticles& ground);
  double mass() const;  ///< [kg]

  void serialise(StateArchive& archive);
  /// Adds all that is kept, for a hash.
  void hashed(std::vector<double>& numbers) const;

 private:
  using Masses = std::array<double, BedColumns::kNodes>;

  /// A column of the lattice, and the place on which the next particle would lie.
  struct Stack {
    double x, y;
    long next;
  };
  std::vector<Stack> stacks_of(int column, int node) const;

  const BedColumns& columns_;
  const GroundSource& source_;
  double ceiling_;
  std::map<int, Masses> masses_;  ///< mass at the nodes of columns, in their order [kg]
};

}  // namespace mpm
