// Walls at the faces of the domain, as accounts see them: which of them holds a node along an axis.
#pragma once

#include "mpm_gpu/views.hpp"

namespace mpm_gpu {

/// Numbers along the axes of a node of the table.
inline void number_of_node(const GridView& grid, int dim, const std::uint64_t* keys, long node, int (&number)[3]) {
  std::uint64_t key = keys[node / nodes_of_block(dim)];
  long local = node % nodes_of_block(dim);
  for (int k = dim - 1; k >= 0; --k, local /= kEdge) {
    const auto along = static_cast<std::uint64_t>(grid.blocks_along[k]);
    number[k] = static_cast<int>(key % along) * kEdge - kBeside + static_cast<int>(local % kEdge);
    key /= along;
  }
}

/// The face, 2 * axis, + 1 for the upper one, whose wall's impulse at a node along an axis counts; -1 without one. In
/// an edge of the domain walls that hold act before those that rub, and the first of a kind takes all.
inline int holding_face(const GridView& grid, int dim, const int* number, int axis) {
  int rubs = -1;
  for (int face = 0; face < 2 * dim; ++face) {
    const int across = face / 2, beyond = face % 2 == 1 ? number[across] - grid.last_node[across] : -number[across];
    if (grid.faces[face] == Face::open || beyond < 0 || beyond > grid.wall_layers) continue;
    if (grid.faces[face] == Face::frictional) {
      if (rubs < 0) rubs = face;
    } else if (across == axis || grid.faces[face] == Face::fixed) {
      return face;
    }
  }
  return rubs;
}

}  // namespace mpm_gpu
