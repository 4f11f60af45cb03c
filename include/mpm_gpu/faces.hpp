// Walls at the faces of the domain: which of them are at a node, and which holds it along an axis.
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

/// The face of an axis, 2 * axis, + 1 for the upper one, with a wall on which or beyond which a node lies; -1 without
/// one.
inline int face_at(const GridView& grid, const int* number, int axis) {
  const int above = number[axis] - grid.last_node[axis], below = -number[axis];
  const bool upper = above >= 0;
  const int beyond = upper ? above : below, face = 2 * axis + (upper ? 1 : 0);
  return beyond >= 0 && beyond <= grid.wall_layers && grid.faces[face] != Face::open ? face : -1;
}

/// The face whose wall holds a node always along an axis, the first of them, which takes all; -1 without one.
inline int holding_face(const GridView& grid, int dim, const int* number, int axis) {
  for (int across = 0; across < dim; ++across) {
    const int face = face_at(grid, number, across);
    if (face < 0 || grid.faces[face] == Face::frictional) continue;
    if (across == axis || grid.faces[face] == Face::fixed) return face;
  }
  return -1;
}

}  // namespace mpm_gpu
