// Detection of contact between two materials at a node: by the volume there, and by how far they are apart. The law
// itself always requires approach as well (contact/pair_law.hpp).
//
// Weak: the distance between two surfaces is read from the mean places of the material on either side. With particles
// in their lattice, two in a cell's edge, touching faces read 0.75 to 0.86 cells, depending on where they lie between
// the nodes, so contact begins up to a tenth of a cell early or late.
// Source: method reference 8.2; manual, Vmin, Dcheck and ContactPosition.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "mpm/contact/node_material.hpp"
#include "mpm/grid/grid_layout.hpp"

namespace mpm {

enum class Detection {
  approach,       ///< wherever both have mass and approach: a cell early
  displacements,  ///< by displacements since the start: for surfaces that touched at the start and move little
  positions       ///< by positions: for surfaces that come to touch
};
inline constexpr std::array<const char*, 3> kDetectionNames = {"approach", "displacements", "positions"};

struct DetectionRule {
  Detection kind = Detection::positions;
  double position = 0.8;  ///< distance of the mean places at which surfaces touch [cells across, along the normal]
  double minimum_volume = 0.0;  ///< volume of all materials at the node, over a cell's; with less there is no contact
};

/// Width of a cell along a direction [m]: the diameter along it of the ellipsoid in the cell, which is the edge along
/// an axis, and everywhere in a cell of equal edges.
inline double across_cell(const GridLayout& layout, const Vec3& direction) {
  double sum = 0.0;
  for (int k = 0; k < layout.dim(); ++k) {
    const double c = direction[layout.axis(k)] * layout.inverse_cell(k);
    sum += c * c;
  }
  return sum > 0.0 ? 1.0 / std::sqrt(sum) : layout.smallest_cell();
}

/// Distance between the surfaces along the normal from a to b; negative where they touch or overlap [m].
/// NodeMaterial::place is a position or a displacement, as the rule asks for.
inline double separation(const DetectionRule& rule, const NodeMaterial& a, const NodeMaterial& b, const Vec3& normal,
                         double across) {
  const double apart = (b.place - a.place).dot(normal);
  return rule.kind == Detection::positions ? apart - rule.position * across : apart;
}

/// Area of the surface between two materials that falls to the node [m^2]: sqrt(2 min(Va, Vb) (Va + Vb)) / width of the
/// cell. For a plane at distance d from the node it is exactly 1 - d/h of a cell's face. Method reference 8.4.
inline double contact_area(double volume_a, double volume_b, double across) {
  return std::sqrt(2.0 * std::min(volume_a, volume_b) * (volume_a + volume_b)) / across;
}

}  // namespace mpm
