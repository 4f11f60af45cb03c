// A rigid body as particles that fill its surface and move with its pose: their volume, volume gradient and mean place
// at nodes of the grid, as for rigid materials in the sources. They carry no momentum.
//
// The lattice lies in the body's own frame, so a body that turns keeps its particles; their boxes stay along the grid's
// axes, and are cut off at mirrors (Grid::mirrored) as the material ends there. Their functions are uGIMP's; about the
// axis of revolution those with the weight r, as the material's are. Particles deeper than three cells below the
// surface are left out, since they reach no node that material reaches. Weak: the surface is a staircase of particles,
// and a tool thinner than one holds none. Source: manual, rigid materials with SetDirection 8; method
// reference 8.1, 2.1; Nairn & Guilkey (2015) eq. (55) and section 3.3.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mpm/grid/grid_layout.hpp"
#include "mpm/grid/nodal_fields.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/shape/radial_box.hpp"

namespace mpm {

class RigidParticles {
 public:
  /// `per_cell`: particles along a cell's edge; `across`: thickness or area beside the grid's axes, 1 in a solid.
  /// `body` and `grid`, of which the layout and the mirrors are used, must outlive this object. @throws RigidError for
  /// a body without end, or one that holds no particle.
  RigidParticles(const RigidBody& body, const Grid& grid, GeometryKind geometry, int per_cell, double across);

  /// Sums at the nodes of the blocks with these keys (ascending), as the body lies now.
  void gather(const std::vector<std::uint64_t>& keys);

  /// Sum of V S at a node [m^3]; about an axis V is the area of a section. `block`: index in `keys`.
  double volume(int block, int node) const { return volume_.at(block, 0, node); }
  /// Sum of V G, out of the body [m^2].
  Vec3 gradient(int block, int node) const;
  /// Mean position, by volume, where there is any [m].
  Vec3 position(int block, int node) const;
  /// Mean displacement since the start, by volume [m].
  Vec3 displacement(int block, int node) const;
  int size() const { return static_cast<int>(local_.size()); }

 private:
  /// A box along one grid axis, cut off at mirrors.
  struct Along {
    int first;             ///< node that the functions begin at
    double part;           ///< remaining part of the box
    double middle;         ///< middle of the remaining part [cells]
    RadialBox<double> of;  ///< values, and gradients [1/m], at three nodes
  };
  /// Empty if the box lies beyond a mirror.
  std::optional<Along> along(int k, double cells) const;
  void add(const Vec3& particle, const Vec3& moved, const std::vector<std::uint64_t>& keys);

  const RigidBody& body_;
  const Grid& grid_;
  const GridLayout& layout_;
  bool axisymmetric_;
  Pose start_;
  double half_;              ///< half the edge of a particle's box [cells]
  double volume_each_;       ///< [m^3]
  std::vector<Vec3> local_;  ///< in the body's frame [m]
  NodalField volume_, gradient_, place_, moved_;
};

}  // namespace mpm
