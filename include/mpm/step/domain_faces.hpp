// Faces of particles' domains, on which loads and fluxes act: where they are, how large, and the shares of the nodes
// around their corners.
//
// The domain is the one that the scene's shape function has in this step: uGIMP's box, the box of ugimp_stretch, the
// deformed domain of CPDI and qCPDI, each cut off or made smaller at r = 0 as there. dirac and the B-splines have no
// box: the one that the particle had at the start stands in. A corner may lie where dirac or a spline folded at a wall
// puts no mass: what such a node should take goes to the other nodes of the corner's cell.
// Source: Nairn & Guilkey (2015) eq. (40)-(55); method reference 4.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/grid/node_choice.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/ranks/halo.hpp"
#include "mpm/shape/kind.hpp"
#include "mpm/shape/traction.hpp"
#include "mpm/step/material_nodes.hpp"
#include "mpm/step/step_context.hpp"

namespace mpm {

/// Settings that all faces of a scene share.
struct FaceSettings {
  GeometryKind geometry = GeometryKind::solid;
  ShapeKind shape = ShapeKind::ugimp;
  double across = 1.0;                 ///< thickness of a plane [m], area of a line [m^2]
  const NodeChoice* choice = nullptr;  ///< choice of a field at every node; may be null
  Halo* halo = nullptr;                ///< exchange with ranks that give to the same nodes; may be null
};

/// The nodes of the cell that a place is in, with shares that sum to 1.
struct NodeShares {
  int count = 0;
  std::array<int, 8> field{};  ///< field of each
  std::array<NodeRef, 8> node{};
  std::array<double, 8> share{};
};

/// Shares of a place by grid axis [m], in the nodes of the material there. A count of 0: no node around it carries any.
NodeShares node_shares(const MaterialNodes& material, const PlacedDomain::Vector& at);

class DomainFaces {
 public:
  /// `fields` and `sets` outlive this.
  DomainFaces(const FaceSettings& settings, const Fields& fields, const std::vector<ParticleSet>& sets)
      : settings_(settings), fields_(fields), sets_(sets) {}

  /// The face of a particle as the step begins; its area is that of the whole ring about an axis [m^2].
  FaceParts parts(int set, int particle, DomainFace face) const;
  /// The same of the box that a particle, which may be asleep, had at the start, where it is now.
  FaceParts parts_of_box(int set, int particle, DomainFace face) const;
  /// Shares of a corner of that face, in the particle's velocity fields.
  NodeShares shares(int set, int particle, const PlacedDomain::Vector& at) const;
  const GridLayout& layout() const { return fields_.front()->layout; }

 private:
  PlacedDomain domain_of(const ParticleSet& set, int p) const;
  double across(const ParticleSet& set, int p) const;

  FaceSettings settings_;
  const Fields& fields_;
  const std::vector<ParticleSet>& sets_;
};

/// Finds the places of a set's particles, by id from the set's first up to the last that is here; -1 for those on other
/// ranks.
void find_places(const ParticleSet& set, std::vector<int>& place_of);

/// Returns the particles of a set, not sorted yet, that no other lies beyond in their row along the face's axis, by
/// place in the set; over several ranks, which have parts of it, by id from the set's first. Rows are those of the
/// lattice that boxes of the set's size make on the grid. `ranks`: null for a process that is alone. Collective.
std::vector<std::uint32_t> outermost_particles(const ParticleSet& set, const GridLayout& layout, DomainFace face,
                                               Communicator* ranks = nullptr);

}  // namespace mpm
