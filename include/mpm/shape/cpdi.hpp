// CPDI: hat functions averaged over the particle's deformed domain, a parallelogram or parallelepiped, where each hat
// is replaced by its multilinear interpolation between the domain's corners. This gives a sum over the corners,
//
//   S_i = sum_a w_a N_i(x_a),   G_i = sum_a N_i(x_a) g_a,   N the multilinear hat,
//
// which holds for any stretch, shear and rotation; the domains continue to tile a body that deforms evenly. Weak: under
// shear without end, domains become long and thin and corners of neighbours tangle; a half vector longer than about a
// cell smears the fields, since the hat between the corners is not seen; a domain whose corners would lie more than 1.5
// cells from its particle is shrunk (kernel/domain.hpp) and no longer follows the deformation; an undeformed domain is
// uGIMP's box, but the sums differ from uGIMP's where it crosses a grid line (with half-width w in cells and the
// particle on a node, the node's weight along each axis is 1 - w here and 1 - w/2 there). Cost: up to 4^dimensions
// nodes. Source: Sadeghirad, Brannon & Burghardt (2011) eq. (20), (21); Nairn & Guilkey (2015) eq. (31); method
// reference 2.5, 2.6.
#pragma once

#include "mpm/shape/particle_domain.hpp"
#include "mpm/shape/traits.hpp"

namespace mpm {

/// The corners of a domain. `d[k][c]`: component c of half vector k (shape/particle_domain.hpp), in any unit of length.
template <int Dim>
struct Cpdi : ShapeDefaults {
  static constexpr int kPoints = 1 << Dim;
  static constexpr ShapeKind kKind = ShapeKind::cpdi;
  static constexpr const char *kName = "cpdi", *kOtherName = "lcpdi";
  static constexpr int kDegree = 0;
  static constexpr Follows kFollows = Follows::deformation;
  static constexpr int kMostNodes = 4;  // two at each of two corners
  static constexpr bool kShearLimitsStep = true;

  /// The side of the particle along half vector `k` on which corner `a` lies, -1 or 1: bit k of a. In the plane the
  /// corners 1, 2, 3, 4 of the papers, counter-clockwise, are 0, 1, 3, 2 here.
  static constexpr int side(int a, int k) { return (a >> k & 1) != 0 ? 1 : -1; }

  /// w_a; the weights sum to 1.
  static constexpr double weight(int /*a*/) { return 1.0 / kPoints; }

  /// x_a - x_p, in the unit of d.
  template <class T>
  static void offsets(const T (&d)[Dim][Dim], T (&offset)[kPoints][Dim]) {
    for (int c = 0; c < Dim; ++c) {
      offset[0][c] = -d[0][c];
      offset[1][c] = d[0][c];
      for (int k = 1; k < Dim; ++k) {
        for (int a = 0; a < 1 << k; ++a) {
          offset[a + (1 << k)][c] = offset[a][c] + d[k][c];
          offset[a][c] -= d[k][c];
        }
      }
    }
  }

  /// g_a, per unit of d: w_a times the sum over k of the corner's side times the reciprocal of d_k. The sum over a is
  /// 0.
  template <class T>
  static void gradients(const T (&d)[Dim][Dim], T (&g)[kPoints][Dim]) {
    T r[Dim][Dim];
    reciprocal(d, r);
    for (auto& vector : r) {
      for (T& component : vector) component *= T(weight(0));
    }
    offsets(r, g);
  }
};

}  // namespace mpm
