// Contact between all materials of one node.
//
// Two materials: their law, once. Three and more: the manual sets each against the lump of the others, which conserves
// momentum only by symmetry and knows one law. Here pairs act one after the other in a fixed order, each from the
// velocities that the others left, and take back their earlier impulse; sweeps are repeated until nothing changes.
// Every impulse has an opposite one, so momentum is conserved to round-off after any number of sweeps. The converged
// impulses satisfy the laws of all pairs at once, since a pair's law sees its whole impulse and not the share of one
// sweep (projected Gauss-Seidel, as for rigid bodies: Catto (2005), "Iterative dynamics with temporal coherence").
// Weak: materials with a very small mass beside others need many sweeps; after kMostNodeSweeps the node is left as it
// is.
#pragma once

#include <optional>
#include <vector>

#include "mpm/contact/node_material.hpp"
#include "mpm/contact/pair_law.hpp"
#include "mpm/contact/pair_normal.hpp"

namespace mpm {

constexpr int kMostNodeSweeps = 200;

/// Two materials of a node, and the law between them in this step.
struct NodePair {
  int a = 0, b = 0;  ///< indices of the node's materials
  PairNormals normals;
  bool opposite = true;                     ///< the two normals are opposite, so momentum is conserved
  FrictionLaw friction;                     ///< used where there is no interface
  const InterfaceLaw* interface = nullptr;  ///< an imperfect interface
  bool touching = false;                    ///< result of the detection; not used for an interface
  double area = 0.0;                        ///< [m^2]
  double bond = 0.0;                        ///< unbroken adhesion: strength times area times step [N s]
  Vec3 opening = Vec3::Zero();              ///< opening of an interface, u_b - u_a [m]
  /// Slip of b on a at the start of the step, as strain saw it [m/s]: friction acts in the mean of this and of the slip
  /// that is left (step/node_loss.hpp). None: the slip before contact, of a blow.
  std::optional<Vec3> start_slip;

  /// In passes that do not apply the law (strain, filters): the directions that are held, whatever the impulse.
  PairHold keep = PairHold::none;

  // Results.
  PairHold hold = PairHold::none;
  Vec3 on_a = Vec3::Zero(), on_b = Vec3::Zero();  ///< impulses [N s]
  double friction_energy = 0.0;                   ///< taken by sliding [J]
};

/// Applies the laws to the velocities of the node's materials. Returns the number of sweeps.
int solve_contact(std::vector<NodeMaterial>& materials, std::vector<NodePair>& pairs, double dt);

}  // namespace mpm
