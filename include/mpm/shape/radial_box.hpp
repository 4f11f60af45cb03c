// Hat functions averaged over a box along the radius of an axisymmetric scene, the section of a ring: weighted with r
// for values and gradients, S_r and dS_r, and with 1 for the hoop direction, T_r. Along the axis the functions are the
// planar ones.
//
//   S = I1 / D,   dS = ([r N] - I0) / D,   T = I0 / D,   I_k = integral of r^k N over the box [a, b],
//   D = (b^2 - a^2)/2
//
// Weak: S averages at the centre of mass, so the sum of S r_i is not the particle's radius but <r^2>/<r>, larger by a
// third beside the axis; moving a particle by S moves it too fast there (shape/axis_rules.hpp, AxisMotion). Source:
// Nairn & Guilkey (2015) eq. (17)-(29); branch-free form of method reference 3.3. The planar alternative, eq. (68),
// (69), has T = S / r.
#pragma once

#include "mpm/math/lanes.hpp"

namespace mpm {

/// Values and gradients at the three nodes nearest-1, nearest, nearest+1 along the radius.
template <class T>
struct RadialBox {
  T s[3];  ///< shape function, sums to 1
  T g[3];  ///< its radial gradient [1/m], sums to 0
  T t[3];  ///< hoop function [1/m], sums to 1/<r>

  /// All lengths in cells: `offset` is the particle's position relative to its nearest node, in [-1/2, 1/2]; `node` is
  /// that node's radius; the box runs from `below` to `above`, both relative to the node and at most a cell from it.
  /// `inverse_cell` in [1/m].
  RadialBox(T offset, T node, T below, T above, T inverse_cell, bool planar) {
    const T zero(0);
    const T width = above - below, middle = T(0.5) * (below + above) + node;
    // With x counted from the nearest node, r N is x (node + x) for the upper node and -x (node + x) for the lower one.
    const T a = max(below, zero), b = max(above, zero), c = min(above, zero), d = min(below, zero);
    const T upper = T(0.5) * (b * b - a * a), lower = T(0.5) * (d * d - c * c);
    const T of_ring = T(1) / (width * middle);
    const T scale = planar ? T(1) / width : of_ring;
    const T at = planar ? T(1) : node, slant(planar ? 0.0 : 1.0);
    s[2] = scale * (at * upper + slant * T(1.0 / 3.0) * (b * b * b - a * a * a));
    s[0] = scale * (at * lower + slant * T(1.0 / 3.0) * (d * d * d - c * c * c));
    s[1] = T(1) - s[0] - s[2];
    const T slope = scale * inverse_cell;
    g[2] = slope * (at * (b - a) + slant * upper);
    g[0] = -slope * (at * (c - d) - slant * lower);
    g[1] = -g[0] - g[2];
    const T hoop = (planar ? T(1) / (width * (node + offset)) : of_ring) * inverse_cell;
    t[2] = hoop * upper;
    t[0] = hoop * lower;
    t[1] = hoop * width - t[0] - t[2];
  }
};

}  // namespace mpm
