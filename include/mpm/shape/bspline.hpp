// B-splines at the particle's centre, quadratic and cubic: smooth (C1, C2) where particles cross cells. Weak: they do
// not see the particle's size, so a body that is stretched until cells empty falls apart; a body's surface is smeared
// over more cells than with hat functions; and a spline reaches past a wall of the domain, where there is no node.
//
// Folding mends the last weakness. The field is continued beyond a wall in a straight line through the wall's node and
// the next one inside, u(-1) = 2 u(0) - u(1) and u(-2) = 2 u(-1) - u(0), so the weight of a node beyond the wall
// becomes weight of the two nodes inside it:
//
//   S(0) += 2 S(-1), S(1) -= S(-1);   S(0) += 3 S(-2), S(1) -= 2 S(-2);   gradients alike.
//
// This continues a linear field exactly. Sums of weights stay 1 and of gradients 0, linear fields keep their values and
// gradients, and gradients are still the slopes of the values, continuous as before. Inside the domain no weight
// becomes negative: at a distance x >= 0 [cells] from the wall the quadratic spline is the hat function up to x = 1/2,
// and the cubic one is 1 - x + x^3/6, x - x^3/3, x^3/6 there. On the wall the wall's node has all the weight, so a
// condition at that node holds exactly on the wall. The second moment of the weights about the particle, which APIC
// divides by, is h^2/4 and h^2/3 away from walls; next to one it goes to zero, as x (1 - x) h^2 and (x - x^2 + x^3/3)
// h^2.
//
// Source: Steffen, Kirby & Berzins (2008) eq. (12); method reference 2.4. The folding was derived for this project.
#pragma once

#include <initializer_list>

#include "mpm/math/lanes.hpp"
#include "mpm/shape/traits.hpp"

namespace mpm {

/// Data that the splines of all particles of a body share along one axis.
template <class T>
struct SplineAxis {
  T inverse_cell;
  /// The first argument, the half-width of the box, is not used. `per_cell` [1/m].
  SplineAxis(double, double per_cell) : inverse_cell(per_cell) {}
};

/// Moves, where `beyond` holds, the weight of the node `outer`, past a wall, to the next two nodes inward.
template <class T, class Mask>
void fold_node(Mask beyond, T& outer, T& next, T& inner) {
  const T lost = select(beyond, outer, T(0));
  outer -= lost;
  next += lost + lost;
  inner -= lost;
}

/// Values and gradients at the three nodes nearest-1, nearest, nearest+1.
template <class T>
struct QuadraticSpline : ShapeDefaults {
  static constexpr int kNodes = 3;
  static constexpr bool kFoldsAtWalls = true;
  static constexpr ShapeKind kKind = ShapeKind::bspline2;
  static constexpr const char* kName = "bspline2";
  static constexpr int kDegree = 2;
  static constexpr Follows kFollows = Follows::nothing;
  static constexpr int kMostNodes = 3;
  static constexpr double kBeyondNext = 1.0 / 48.0;
  using Axis = SplineAxis<T>;

  T s[3];  ///< shape function, sums to 1
  T g[3];  ///< gradient [1/m], sums to 0

  /// `offset`: particle minus its nearest node, in cells, in [-1/2, 1/2].
  QuadraticSpline(T offset, const Axis& axis) {
    const T below = T(0.5) - offset, above = T(0.5) + offset;
    s[0] = T(0.5) * below * below;
    s[1] = T(0.75) - offset * offset;
    s[2] = T(0.5) * above * above;
    g[0] = -below * axis.inverse_cell;
    g[1] = T(-2) * offset * axis.inverse_cell;
    g[2] = above * axis.inverse_cell;
  }

  /// Folds the weights beyond the walls back into the domain. The arguments are whole numbers >= 0: cells from the
  /// lower wall to the nearest node, and from that node to the upper wall; the domain has at least one cell.
  void fold(T nearest_minus_low, T high_minus_nearest) {
    const auto on_low = nearest_minus_low < T(0.5), on_high = high_minus_nearest < T(0.5);
    for (T* w : {s, g}) {
      fold_node(on_low, w[0], w[1], w[2]);
      fold_node(on_high, w[2], w[1], w[0]);
    }
  }
};

/// Values and gradients at the five nodes nearest-2 to nearest+2; those of one outermost node are 0.
template <class T>
struct CubicSpline : ShapeDefaults {
  static constexpr int kNodes = 5;
  static constexpr bool kFoldsAtWalls = true;
  static constexpr ShapeKind kKind = ShapeKind::bspline3;
  static constexpr const char* kName = "bspline3";
  static constexpr int kDegree = 3, kSurfaceDegree = 3;
  static constexpr Follows kFollows = Follows::nothing;
  static constexpr int kMostNodes = 4;
  static constexpr double kBeyondNext = 1.0 / 24.0;
  using Axis = SplineAxis<T>;

  T s[5];  ///< shape function, sums to 1
  T g[5];  ///< gradient [1/m], sums to 0

  /// `offset`: particle minus its nearest node, in cells, in [-1/2, 1/2].
  CubicSpline(T offset, const Axis& axis) {
    // The spline as a sum of truncated powers: 6 N(a) = (2-a)^3 for a < 2, minus 4 (1-a)^3 for a < 1.
    const T sixth(1.0 / 6.0), half(0.5), four(4.0);
    const T under = max(-offset, T(0)), over = max(offset, T(0));
    const T below = T(1) - offset, above = T(1) + offset;
    const T under2 = under * under, over2 = over * over, below2 = below * below, above2 = above * above;
    s[0] = sixth * under2 * under;
    s[1] = sixth * below2 * below - four * s[0];
    s[4] = sixth * over2 * over;
    s[3] = sixth * above2 * above - four * s[4];
    s[2] = T(1) - s[0] - s[1] - s[3] - s[4];
    const T slope = half * axis.inverse_cell;
    g[0] = -slope * under2;
    g[1] = slope * (four * under2 - below2);
    g[4] = slope * over2;
    g[3] = slope * (above2 - four * over2);
    g[2] = slope * (T(3) * (over2 - under2) - four * offset);
  }

  /// As in QuadraticSpline.
  void fold(T nearest_minus_low, T high_minus_nearest) {
    const auto near_low = nearest_minus_low < T(1.5), on_low = nearest_minus_low < T(0.5);
    const auto near_high = high_minus_nearest < T(1.5), on_high = high_minus_nearest < T(0.5);
    for (T* w : {s, g}) {
      fold_node(near_low, w[0], w[1], w[2]);
      fold_node(on_low, w[1], w[2], w[3]);
      fold_node(near_high, w[4], w[3], w[2]);
      fold_node(on_high, w[3], w[2], w[1]);
    }
  }
};

}  // namespace mpm
