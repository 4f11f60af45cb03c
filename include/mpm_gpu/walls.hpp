// Walls at the nodes that they hold, as mpm/boundary/wall.hpp has them: fixed and slip walls hold always, frictional
// ones by Coulomb's law and let go. Those that always hold act first; what friction gives has no part along their axes.
// Source: Nairn, GIMP notes (3.12)-(3.20); that a held node stays held for the strain: step/coulomb.hpp.
#pragma once

#include "mpm_gpu/faces.hpp"

namespace mpm_gpu {

/// State of contact of a node and a wall.
enum Hold : std::uint8_t { kFree = 0, kSlides = 1, kSticks = 2 };

/// State of a node and the wall at a face of an axis, in NodeView::hold: of the last step and of the one before it.
constexpr Hold held_now(std::uint16_t bits, int axis) { return static_cast<Hold>(bits >> 4 * axis & 3); }
constexpr Hold held_before(std::uint16_t bits, int axis) { return static_cast<Hold>(bits >> (4 * axis + 2) & 3); }
constexpr std::uint16_t with_now(std::uint16_t bits, int axis, Hold hold) {
  return static_cast<std::uint16_t>((bits & ~(3 << 4 * axis)) | hold << 4 * axis);
}
/// Turns what is now into the step before; nothing is held now.
constexpr std::uint16_t a_step_later(std::uint16_t bits) { return static_cast<std::uint16_t>((bits & 0x333) << 2); }

/// Removes from `v` what a held node does not have, an increment or a velocity.
template <int Dim>
void hold_part(int face, Hold hold, double (&v)[Dim]) {
  for (int c = 0; c < Dim; ++c) {
    if (hold == kSticks || (hold == kSlides && c == face / 2)) v[c] = 0.0;
  }
}

/// State of a node and a wall that always holds.
inline Hold always(const GridView& grid, int face) { return grid.faces[face] == Face::fixed ? kSticks : kSlides; }

/// visit(face) for the walls at a node: those that always hold, then the frictional ones.
template <int Dim, class Visit>
void each_wall_at(const GridView& grid, const int* number, Visit&& visit) {
  int face[Dim];
  bool any = false;
  for (int axis = 0; axis < Dim; ++axis) {
    face[axis] = face_at(grid, number, axis);
    any = any || face[axis] >= 0;
  }
  if (!any) return;
  for (int i = 0; i < 2 * Dim; ++i) {
    const int one = face[i % Dim];
    if (one >= 0 && (grid.faces[one] == Face::frictional) == (i >= Dim)) visit(one);
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

/// Action of a frictional wall for the strain: a node that was held is held, one that was free if it approaches.
template <int Dim>
void rub_for_strain(const GridView& grid, int face, Hold held, double (&v)[Dim]) {
  if (held == kFree) {
    touch<Dim>(grid, face, v);
  } else {
    hold_part<Dim>(face, held, v);
  }
}
/// Action of a wall on an increment.
template <int Dim>
void hold_one_increment(const GridView& grid, const NodeView& nodes, int face, long node, double (&v)[Dim]) {
  const bool rubs = grid.faces[face] == Face::frictional;
  hold_part<Dim>(face, rubs ? held_now(nodes.hold[node], face / 2) : always(grid, face), v);
}
/// Keeps what a wall gives beside its first impulse of the step, a change from `free` to `v` of this mass.
template <int Dim>
void give_more(const NodeView& nodes, int face, long node, double mass, const double (&free)[Dim],
               const double (&v)[Dim]) {
  const int row = nodes.held_rows == 1 ? 0 : face / 2;
  for (int c = 0; mass > 0.0 && c < Dim; ++c) {
    nodes.held_more[(row * Dim + c) * nodes.nodes + node] += mass * (v[c] - free[c]);
  }
}

// All walls at a node; near rigid bodies only those that always hold, which are to act once more after contact.

/// Velocity for the strain.
template <int Dim>
void hold_for_strain(const GridView& grid, const NodeView& nodes, long node, const int* number, double (&v)[Dim]) {
  each_wall_at<Dim>(grid, number, [&](int face) {
    for (int c = 0; nodes.moved != nullptr && c < Dim; ++c) nodes.moved[c * nodes.nodes + node] = 0.0;
    if (grid.faces[face] != Face::frictional) {
      hold_part<Dim>(face, always(grid, face), v);
    } else if (!is_near(nodes, node)) {
      rub_for_strain<Dim>(grid, face, held_now(nodes.hold[node], face / 2), v);
    }
  });
}

/// Velocity of the step's end, of which contact is decided; keeps what each wall gives to the mass of the node.
template <int Dim>
void hold_at_end(const GridView& grid, const NodeView& nodes, long node, const int* number, double mass,
                 double (&v)[Dim]) {
  const bool carries = mass > grid.least_mass;
  std::uint16_t bits = 0;
  bool any = false;
  each_wall_at<Dim>(grid, number, [&](int face) {
    const int axis = face / 2, row = nodes.held_rows == 1 ? 0 : axis;
    const bool adds = nodes.held_rows == 1 && any;
    if (!any && nodes.hold != nullptr) bits = a_step_later(nodes.hold[node]);
    any = true;
    double free[Dim];
    for (int c = 0; c < Dim; ++c) free[c] = v[c];
    Hold hold = always(grid, face);
    if (grid.faces[face] != Face::frictional) {
      hold_part<Dim>(face, hold, v);
    } else {
      hold = is_near(nodes, node) ? kFree : touch<Dim>(grid, face, v);
    }
    bits = with_now(bits, axis, carries ? hold : kFree);
    for (int c = 0; c < Dim; ++c) {
      const long at = (row * Dim + c) * nodes.nodes + node;
      nodes.held[at] = (adds ? nodes.held[at] : 0.0) + mass * (v[c] - free[c]);
      if (nodes.held_more != nullptr) nodes.held_more[at] = 0.0;
    }
  });
  if (!any) return;
  if (nodes.hold != nullptr) nodes.hold[node] = bits;
  for (int c = 0; nodes.left != nullptr && c < Dim; ++c) nodes.left[c * nodes.nodes + node] = v[c];
}

/// Increments of the velocity of the step's end, of a node of this mass; keeps what each wall gives. A mass of 0 where
/// nothing is added yet.
template <int Dim>
void hold_increment(const GridView& grid, const NodeView& nodes, long node, const int* number, double mass,
                    double (&v)[Dim]) {
  each_wall_at<Dim>(grid, number, [&](int face) {
    if (grid.faces[face] == Face::frictional && is_near(nodes, node)) return;
    double free[Dim];
    for (int c = 0; c < Dim; ++c) free[c] = v[c];
    hold_one_increment<Dim>(grid, nodes, face, node, v);
    give_more<Dim>(nodes, face, node, mass, free, v);
  });
}

// Near rigid bodies, when contact with them has acted: frictional walls, then once more those that always hold.

/// visit(face) in that order.
template <int Dim, class Visit>
void each_wall_again(const GridView& grid, const int* number, Visit&& visit) {
  for (const bool rubs : {true, false}) {
    each_wall_at<Dim>(grid, number, [&](int face) {
      if ((grid.faces[face] == Face::frictional) == rubs) visit(face);
    });
  }
}

template <int Dim>
void hold_again_for_strain(const GridView& grid, const NodeView& nodes, long node, const int* number,
                           double (&v)[Dim]) {
  each_wall_again<Dim>(grid, number, [&](int face) {
    if (grid.faces[face] == Face::frictional) {
      rub_for_strain<Dim>(grid, face, held_now(nodes.hold[node], face / 2), v);
    } else {
      hold_part<Dim>(face, always(grid, face), v);
    }
  });
}
template <int Dim>
void hold_again_at_end(const GridView& grid, const NodeView& nodes, long node, const int* number, double mass,
                       double (&v)[Dim]) {
  each_wall_again<Dim>(grid, number, [&](int face) {
    double free[Dim];
    for (int c = 0; c < Dim; ++c) free[c] = v[c];
    if (grid.faces[face] != Face::frictional) {
      hold_part<Dim>(face, always(grid, face), v);
      give_more<Dim>(nodes, face, node, mass, free, v);
      return;
    }
    const Hold hold = touch<Dim>(grid, face, v);
    nodes.hold[node] = with_now(nodes.hold[node], face / 2, mass > grid.least_mass ? hold : kFree);
    for (int c = 0; c < Dim; ++c) {
      nodes.held[(face / 2 * Dim + c) * nodes.nodes + node] = mass * (v[c] - free[c]);
      nodes.left[c * nodes.nodes + node] = v[c];
    }
  });
}
template <int Dim>
void hold_increment_again(const GridView& grid, const NodeView& nodes, long node, const int* number, double mass,
                          double (&v)[Dim]) {
  each_wall_again<Dim>(grid, number, [&](int face) {
    double free[Dim];
    for (int c = 0; c < Dim; ++c) free[c] = v[c];
    hold_one_increment<Dim>(grid, nodes, face, node, v);
    give_more<Dim>(nodes, face, node, mass, free, v);
  });
}

}  // namespace mpm_gpu
