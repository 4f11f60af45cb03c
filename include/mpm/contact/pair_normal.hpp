// The normal of the surface between two materials at a node, from their volume gradients.
//
// Weak: gradients of a surface oblique to the grid are off by some degrees, and the four choices differ most where one
// side has few particles; where a rigid body has a surface, its exact normal is better.
// Source: method reference 8.1; manual, MultiMaterialMode, Normals and RigidBias; Lemiale, Nairn & Hurmane (2010).
#pragma once

#include <array>

#include "mpm/contact/node_material.hpp"

namespace mpm {

/// Source of the normal, in the order of the manual's Normals 0 to 3.
enum class NormalMethod {
  larger_gradient,  ///< normal of the material whose gradient is longer
  larger_volume,    ///< normal of the material with more volume at the node; without rigid bias
  average,          ///< mean of both, weighted by volume
  own               ///< each material uses its own: momentum is not conserved where the two are not opposite
};
inline constexpr std::array<const char*, 4> kNormalNames = {"larger_gradient", "larger_volume", "average", "own"};

struct NormalRule {
  NormalMethod method = NormalMethod::average;
  /// Against a rigid material the normal is the rigid one's, unless the other candidate is this many times as long.
  double rigid_bias = 1.0;
};

/// Unit normals from a to b, for the impulse on a and for that on b: equal but for NormalMethod::own. Zero where
/// there is no gradient.
struct PairNormals {
  Vec3 of_a, of_b;
};
/// The normals of a pair. At most one of the two materials is rigid.
PairNormals pair_normals(const NormalRule& rule, const NodeMaterial& a, const NodeMaterial& b);

}  // namespace mpm
