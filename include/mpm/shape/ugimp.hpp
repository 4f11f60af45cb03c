// uGIMP: hat functions averaged over a box that moves with the particle and keeps its size. C1 within a step's reach,
// so without cell-crossing noise. Weak at large strain: the boxes overlap or leave gaps, and convergence stalls.
// Source: Nairn, GIMP notes (4.9)-(4.12); Nairn & Guilkey (2015) (68), (69); branch-free form of method reference 2.1.
//
// Along one axis a box of half-width w <= 1/2 cell touches the particle's nearest node and its two neighbours.
#pragma once

#include "mpm/math/lanes.hpp"
#include "mpm/shape/traits.hpp"

namespace mpm {

/// Values and gradients at the three nodes nearest-1, nearest, nearest+1.
template <class T>
struct Ugimp : ShapeDefaults {
  static constexpr int kNodes = 3;  ///< along an axis
  static constexpr ShapeKind kKind = ShapeKind::ugimp;
  static constexpr const char *kName = "ugimp", *kOtherName = "gimp";
  static constexpr int kDegree = 0;
  static constexpr Follows kFollows = Follows::nothing;
  static constexpr int kMostNodes = 3;
  static constexpr bool kTakesImplicit = true;

  /// Data that all particles of a body share along one axis.
  struct Axis {
    T half, scale, slope;
    /// `half`: w, half the box in cells, (0, 1/2]; `inverse_cell` [1/m].
    Axis(double w, double inverse_cell) : half(w), scale(1.0 / (4.0 * w)), slope(inverse_cell / (2.0 * w)) {}
    /// Data for half-widths that differ between particles: w, 1/(4 w), and inverse_cell/(2 w) [1/m].
    Axis(T w, T quarter_over_w, T per_box) : half(w), scale(quarter_over_w), slope(per_box) {}
  };

  T s[3];  ///< shape function, sums to 1
  T g[3];  ///< gradient [1/m], sums to 0

  /// `offset`: particle minus its nearest node, in cells, in [-1/2, 1/2]. Always inline: a call would pass its
  /// registers through memory, which costs a tenth of a step in a plane.
  [[gnu::always_inline]] Ugimp(T offset, const Axis& axis) {
    const T a = max(offset + axis.half, T(0)), b = max(offset - axis.half, T(0));
    const T c = min(offset - axis.half, T(0)), d = min(offset + axis.half, T(0));
    s[0] = (c * c - d * d) * axis.scale;
    s[2] = (a * a - b * b) * axis.scale;
    s[1] = T(1) - s[0] - s[2];
    g[0] = (c - d) * axis.slope;
    g[2] = (a - b) * axis.slope;
    g[1] = -g[0] - g[2];
  }
};

}  // namespace mpm
