// Receiver of the heat of contact between any surfaces: what friction took at a place, and what touches there.
// A run without heat has none.
#pragma once

#include <cstdint>

#include "mpm/grid/nodal_fields.hpp"
#include "mpm/math/geometry.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/step/material_nodes.hpp"

namespace mpm {

class HeatSink {
 public:
  virtual ~HeatSink() = default;

  /// A rigid body touches material, which has these nodes, at a place over `area` [m^2] in this step of `dt` [s], where
  /// friction took `friction` [J].
  virtual void touch(const RigidBody& tool, const MaterialNodes& material, const Vec3& place, double area,
                     double friction, double dt) = 0;
  /// The same at a node (HeldNodes::id) of a velocity field's grid, without an area. No tool: a wall, which takes no
  /// heat.
  virtual void rub(const RigidBody* tool, const Grid& grid, std::uint64_t node, double friction, double dt) = 0;
  /// The material of two grids meets at a node.
  virtual void meet(const Grid& one, const Grid& other, std::uint64_t node, double area, double friction,
                    double dt) = 0;
};

}  // namespace mpm
