// Walls at the nodes that they hold, as mpm/boundary/wall.hpp has them: fixed and slip walls hold always, frictional
// ones by Coulomb's law and let go. Those that always hold act first; what friction gives has no part along their axes.
// Source: Nairn, GIMP notes (3.12)-(3.20); that a held node stays held for the strain: step/coulomb.hpp.
#pragma once

#include "mpm_gpu/views.hpp"

namespace mpm_gpu {

/// State of contact of a node and a frictional wall.
enum Hold : std::uint8_t { kFree = 0, kSlides = 1, kSticks = 2 };

/// True if a node is on a wall or in the layers beyond it.
inline bool on_wall(const GridView& grid, const int* number, int face) {
  const int axis = face / 2, beyond = face % 2 == 1 ? number[axis] - grid.last_node[axis] : -number[axis];
  return grid.faces[face] != Face::open && beyond >= 0 && beyond <= grid.wall_layers;
}

/// Holds `v` along the axes of walls that always hold.
template <int Dim>
void hold_always(const GridView& grid, const int* number, double (&v)[Dim]) {
  for (int face = 0; face < 2 * Dim; ++face) {
    if (grid.faces[face] == Face::frictional || !on_wall(grid, number, face)) continue;
    for (int c = 0; c < Dim; ++c) {
      if (grid.faces[face] == Face::fixed || c == face / 2) v[c] = 0.0;
    }
  }
}

/// Removes from `v` what a held node does not have, an increment or a velocity.
template <int Dim>
void hold_part(int face, Hold hold, double (&v)[Dim]) {
  for (int c = 0; c < Dim; ++c) {
    if (hold == kSticks || (hold == kSlides && c == face / 2)) v[c] = 0.0;
  }
}

/// Contact with a frictional wall: `v` of a node that approaches it loses that, and by friction of what is along it.
template <int Dim>
Hold touch(const GridView& grid, int face, double (&v)[Dim]) {
  const int axis = face / 2;
  const double approach = face % 2 == 0 ? v[axis] : -v[axis];
  if (!(approach < 0.0)) return kFree;
  double square = 0.0;
  for (int c = 0; c < Dim; ++c) square += c == axis ? 0.0 : v[c] * v[c];
  const double sliding = __builtin_sqrt(square), limit = -grid.friction[face] * approach;
  const Hold hold = sliding <= limit ? kSticks : kSlides;
  hold_part(face, hold, v);
  for (int c = 0; hold == kSlides && c < Dim; ++c) v[c] -= v[c] * (limit / sliding);
  return hold;
}

/// True if contact with rigid bodies acts at a node between the walls that always hold and the frictional ones.
inline bool is_near(const NodeView& nodes, long node) { return nodes.near != nullptr && nodes.near[node] != 0; }

/// Lets frictional walls act on the velocity for the strain: a node that was held is held, one that was free if it
/// approaches.
template <int Dim>
void rub_for_strain(const GridView& grid, const NodeView& nodes, long node, const int* number, double (&v)[Dim]) {
  for (int face = 0; face < 2 * Dim; ++face) {
    if (grid.faces[face] != Face::frictional || !on_wall(grid, number, face)) continue;
    const auto hold = static_cast<Hold>(nodes.hold[face * nodes.nodes + node]);
    if (hold == kFree) {
      touch<Dim>(grid, face, v);
    } else {
      hold_part<Dim>(face, hold, v);
    }
  }
}
/// The same for that of the step's end, by which their contact is decided.
template <int Dim>
void rub_at_end(const GridView& grid, const NodeView& nodes, long node, const int* number, double (&v)[Dim]) {
  for (int face = 0; face < 2 * Dim; ++face) {
    if (grid.faces[face] != Face::frictional) continue;
    nodes.hold[face * nodes.nodes + node] = on_wall(grid, number, face) ? touch<Dim>(grid, face, v) : kFree;
  }
}
/// The same for increments of that.
template <int Dim>
void rub_increment(const GridView& grid, const NodeView& nodes, long node, double (&v)[Dim]) {
  for (int face = 0; face < 2 * Dim; ++face) {
    if (grid.faces[face] != Face::frictional) continue;
    hold_part<Dim>(face, static_cast<Hold>(nodes.hold[face * nodes.nodes + node]), v);
  }
}

// All walls at a node; near rigid bodies those that always hold, as the first of two times.

template <int Dim>
void hold_for_strain(const GridView& grid, const NodeView& nodes, long node, const int* number, double (&v)[Dim]) {
  hold_always<Dim>(grid, number, v);
  if (!is_near(nodes, node)) rub_for_strain<Dim>(grid, nodes, node, number, v);
}
template <int Dim>
void hold_at_end(const GridView& grid, const NodeView& nodes, long node, const int* number, double (&v)[Dim]) {
  hold_always<Dim>(grid, number, v);
  if (!is_near(nodes, node)) rub_at_end<Dim>(grid, nodes, node, number, v);
}
template <int Dim>
void hold_increment(const GridView& grid, const NodeView& nodes, long node, const int* number, double (&v)[Dim]) {
  hold_always<Dim>(grid, number, v);
  if (!is_near(nodes, node)) rub_increment<Dim>(grid, nodes, node, v);
}

// Near rigid bodies, when contact with them has acted: frictional walls, then once more those that always hold.

template <int Dim>
void hold_again_for_strain(const GridView& grid, const NodeView& nodes, long node, const int* number,
                           double (&v)[Dim]) {
  rub_for_strain<Dim>(grid, nodes, node, number, v);
  hold_always<Dim>(grid, number, v);
}
template <int Dim>
void hold_again_at_end(const GridView& grid, const NodeView& nodes, long node, const int* number, double (&v)[Dim]) {
  rub_at_end<Dim>(grid, nodes, node, number, v);
  hold_always<Dim>(grid, number, v);
}
template <int Dim>
void hold_increment_again(const GridView& grid, const NodeView& nodes, long node, const int* number, double (&v)[Dim]) {
  rub_increment<Dim>(grid, nodes, node, v);
  hold_always<Dim>(grid, number, v);
}

}  // namespace mpm_gpu
