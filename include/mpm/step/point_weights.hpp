// The grid's velocity at a point of the material's surface: nodes around it and their weights. These are hat
// functions, of which uGIMP and CPDI take averages; with cubic splines they are splines. Internal forces of material
// that is filled up to the point end with the same weights: a traction spread by them is in equilibrium with a uniform
// stress. With quadratic splines hats came out better than splines (a pressed column's force is up to 23 % off with
// them, 33 % with splines): particles half a cell apart are too few to know the end of a spline's support.
//
// Nodes that carry no mass are left out, and the other weights grow in proportion: with dirac, and where a particle is
// stretched beyond the nodes that it reaches.
#pragma once

#include <array>

#include "mpm/shape/kind.hpp"
#include "mpm/step/material_nodes.hpp"

namespace mpm {

struct PointWeights {
  static constexpr int kMost = 125;  ///< number for cubic splines in a solid

  int count = 0;  ///< nodes with a weight; 0: no node around the point carries mass, or it is far out of the domain
  std::array<FieldNode, kMost> node;
  std::array<double, kMost> weight;  ///< sum to 1

  /// `at`: world [m], along the grid's axes.
  PointWeights(const MaterialNodes& nodes, ShapeKind shape, const Vec3& at);
};

}  // namespace mpm
