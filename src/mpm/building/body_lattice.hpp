// The lattice on which a body's particles lie, and the volume that they are to have. A face of a box, of the ground
// under a terrain or of a cylinder's ends that does not lie on a plane of the grid's lattice would come out up to half
// a particle from where it is meant: along that axis the body has a lattice of its own, between its faces. What is
// round or uneven keeps the grid's, and its particles follow the surface (cut_cells.hpp). Private to this folder.
#pragma once

#include <array>
#include <cstdint>

#include "mpm/scene/scene.hpp"

namespace mpm {

/// Lattice positions along an axis whose centres can lie between two bounds: centre i is at origin + (i + 1/2) spacing.
struct Lattice {
  double origin;
  double spacing;
  std::int64_t first;
  std::int64_t last;
  bool own;  ///< it is not the grid's
  double center(std::int64_t i) const { return origin + (static_cast<double>(i) + 0.5) * spacing; }
};

/// Along each axis of the scene's grid; the others have a spacing of 0.
std::array<Lattice, 3> body_lattice(const BodyDefinition& body, const Scene& scene);

/// Volume of a shape that lies on these lattices [m^3]; of one about an axis, of the whole turn.
double body_volume(const Region& region, const Scene& scene, const std::array<Lattice, 3>& lattices);

}  // namespace mpm
