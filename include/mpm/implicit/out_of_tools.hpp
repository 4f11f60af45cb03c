// Particles that an implicit step has left inside a rigid body are put back on its surface. Weak: one that lies in two
// bodies is moved out of one after the other. Source: own derivation.
#pragma once

#include <vector>

#include "mpm/grid/nodal_fields.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/rigid/rigid_body.hpp"

namespace mpm {

class OutOfTools {
 public:
  /// Bodies outlive this.
  OutOfTools(std::vector<RigidBody*> bodies, const GridLayout& layout) : bodies_(std::move(bodies)), layout_(layout) {}

  /// Puts all particles of the sets out. Returns true if one has come so far beyond the block that it was sorted into
  /// that they have to be sorted.
  bool put(std::vector<ParticleSet>& sets, Grid& grid, int threads) const;
  /// The same of one particle of a set at `x` [m], along the grid's axes. Returns true if it lay in a body.
  bool put(const ParticleSet& set, double (&x)[3]) const;
  /// True if a cube of this half edge [m] meets the bounds of a body.
  bool near(const Vec3& place, double half) const;

 private:
  bool put(const RigidBody& body, ParticleSet& set, Grid& grid, int owner) const;
  /// Moves `x` to the body's surface if it lies in it, within the limits of the set. Returns true if it lay there.
  bool move_out(const RigidBody& body, const Box& bounds, const ParticleSet& set, double (&x)[3]) const;

  std::vector<RigidBody*> bodies_;
  GridLayout layout_;
};

}  // namespace mpm
