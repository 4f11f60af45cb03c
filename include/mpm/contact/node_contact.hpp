// Contact between all materials of one node.
//
// Two materials: their law, once. Three and more: the manual sets each against the lump of the others, which conserves
// momentum only by symmetry and knows one law. Here pairs act one after the other in a fixed order, each from the
// velocities that the others left, and take back what they gave before: sweeps until nothing changes. Every impulse
// is on one and against another, so momentum holds to round-off after any number of sweeps. What they settle on
// satisfies the laws of all pairs at once, since a pair's law sees its whole impulse and not a sweep's share
// (projected Gauss-Seidel, as for rigid bodies: Catto (2005), "Iterative dynamics with temporal coherence").
// Weak: materials that hardly weigh anything beside others need many sweeps; after kMostNodeSweeps the node is left as
// is.
#pragma once

#include <vector>

#include "mpm/contact/node_material.hpp"
#include "mpm/contact/pair_law.hpp"
#include "mpm/contact/pair_normal.hpp"

namespace mpm {

constexpr int kMostNodeSweeps = 200;

/// Two materials of a node, and the law between them in this step.
struct NodePair {
  int a = 0, b = 0;  ///< places among the node's materials
  PairNormals normals;
  bool opposite = true;                     ///< normals are one direction: momentum is conserved
  FrictionLaw friction;                     ///< where there is no interface
  const InterfaceLaw* interface = nullptr;  ///< an imperfect interface
  bool touching = false;                    ///< as detected; not asked of an interface
  double area = 0.0;                        ///< [m^2]
  double bond = 0.0;                        ///< adhesion that is still whole: strength times area times step [N s]
  Vec3 opening = Vec3::Zero();              ///< of an interface, u_b - u_a [m]

  /// Where the law has no say any more (strain, filters): the directions that are held, whatever the impulse.
  PairHold keep = PairHold::none;

  // What came of it.
  PairHold hold = PairHold::none;
  Vec3 on_a = Vec3::Zero(), on_b = Vec3::Zero();  ///< impulses [N s]
  double friction_energy = 0.0;                   ///< taken by sliding [J]
};

/// The laws act on the velocities of the node's materials. Returns the number of sweeps.
int solve_contact(std::vector<NodeMaterial>& materials, std::vector<NodePair>& pairs, double dt);

}  // namespace mpm
