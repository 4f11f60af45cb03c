// qCPDI: as CPDI (shape/cpdi.hpp), but each hat is replaced by a biquadratic interpolation over the parallelogram,
// through its values at the corners, the middles of the edges and the centre. Planar. Over a domain that crosses grid
// lines, values are some ten times nearer to the exact average than CPDI's (two domains of the reference); gradients
// are as near or up to five times nearer. Weak: nine points instead of four; corners tangle and must stay on the grid
// and within reach of the tile, as CPDI's; half vectors above a cell still smear the fields. Source: named in the
// NairnMPM manual without formulas; those of method reference 2.7, derived there: Simpson's rule along both half
// vectors, and the mean gradient of the biquadratic.
#pragma once

#include "mpm/shape/particle_domain.hpp"
#include "mpm/shape/traits.hpp"

namespace mpm {

/// The nine points of a domain: point a = 3 (t + 1) + s + 1 lies at s d_0 + t d_1, s and t in {-1, 0, 1}; in the method
/// reference's order the corners are 0, 2, 8, 6, the edges 1, 5, 7, 3 and the centre 4. `d` as for CPDI.
template <int Dim>
struct Qcpdi : ShapeDefaults {
  static_assert(Dim == 2, "qCPDI is planar");
  static constexpr int kPoints = 9;
  static constexpr ShapeKind kKind = ShapeKind::qcpdi;
  static constexpr const char* kName = "qcpdi";
  static constexpr int kDegree = 0;
  static constexpr Follows kFollows = Follows::deformation;
  static constexpr int kMostNodes = 6;  // two at each of three points
  static constexpr bool kMasslessAtAxis = true;

  /// w_a; the weights sum to 1.
  static constexpr double weight(int a) { return a == 4 ? 4.0 / 9.0 : a % 2 == 0 ? 1.0 / 36.0 : 1.0 / 9.0; }

  /// x_a - x_p, in the unit of d.
  template <class T>
  static void offsets(const T (&d)[Dim][Dim], T (&offset)[kPoints][Dim]) {
    for (int c = 0; c < Dim; ++c) spread(c, d[0][c], d[1][c], d[0][c], d[1][c], offset);
  }

  /// g_a, per unit of d. The sum over a is 0, and so is the gradient of the centre.
  template <class T>
  static void gradients(const T (&d)[Dim][Dim], T (&g)[kPoints][Dim]) {
    T r[Dim][Dim];
    reciprocal(d, r);
    const T corner(1.0 / 12.0), edge(1.0 / 3.0);
    for (int c = 0; c < Dim; ++c) spread(c, corner * r[0][c], corner * r[1][c], edge * r[0][c], edge * r[1][c], g);
  }

 private:
  /// Component `c` at every point: s corner0 + t corner1 at the corners, s edge0 or t edge1 on the edges.
  template <class T>
  static void spread(int c, T corner0, T corner1, T edge0, T edge1, T (&point)[kPoints][Dim]) {
    point[0][c] = -corner0 - corner1;
    point[1][c] = -edge1;
    point[2][c] = corner0 - corner1;
    point[3][c] = -edge0;
    point[4][c] = T(0);
    point[5][c] = edge0;
    point[6][c] = corner1 - corner0;
    point[7][c] = edge1;
    point[8][c] = corner0 + corner1;
  }
};

}  // namespace mpm
