// Faces of the domain that are planes of symmetry, for what is found from volume on the grid: the other half of a body
// that rests on such a face is not there. At a node on it the whole has no volume gradient along the face's normal, and
// twice the area that the half has.
//
//   const unsigned axes = grid.symmetry.axes_at(layout, layout.node(block, n));
//   for (int k = 0; k < dim; ++k) if (axes >> k & 1) gradient[k] = 0, area *= 2;
//
// Source: Nairn, GIMP notes, symmetry planes.
#pragma once

#include <array>

#include "mpm/grid/grid_layout.hpp"

namespace mpm {

class SymmetryPlanes {
 public:
  /// `face`: 2 * grid axis, + 1 for the upper one.
  void add(int face) { faces_ |= 1u << face; }
  bool any() const { return faces_ != 0; }
  bool is_plane(int face) const { return (faces_ >> face & 1u) != 0; }

  /// Bit k is set where the node, by its number along each grid axis, lies on a plane across grid axis k, or beyond it.
  unsigned axes_at(const GridLayout& layout, const std::array<int, 3>& node) const {
    unsigned axes = 0;
    for (int k = 0; k < layout.dim(); ++k) {
      const bool on = (is_plane(2 * k) && node[k] <= 0) || (is_plane(2 * k + 1) && node[k] >= layout.last_node(k));
      if (on) axes |= 1u << k;
    }
    return axes;
  }

 private:
  unsigned faces_ = 0;  ///< a bit each
};

}  // namespace mpm
