// Values that a contour around a crack's tip is integrated over, at its nodes, joined by straight pieces, with two
// points at the place where it meets the crack, one on each face.
//
// Nodal values beside the crack are means of material on one side, whose centre is not the node: up to 0.75 cells off.
// Where these centres lie on the contour, as on a crack along the grid, values at the face and at the node are
// taken from the straight line through both. In arms 6 cells thick, whose stress grows toward the faces, J would be
// 2.5 % low without it.
//
// Weak: on a crack askew to the contour values are taken as those of the nodes, and where one of the two nodes has
// none, those of the other stand for both. About an axis they are left at the nodes too: with pressure on the faces J
// would be 1.5 % farther from dU/dA, for a reason that has not been found.
//
// Source: crack reference 4.2; NairnMPM's phantom points.
#pragma once

#include <vector>

#include "mpm/crack/contour.hpp"

namespace mpm {

/// Values of one side of a crack at a place; axes x (or r) and z.
struct ContourValues {
  double gradient[2][2] = {};           ///< u_i,k; in the form of large strain F - I
  double hoop_gradient = 0.0;           ///< u_r / r about an axis; in the form of large strain u_r / R
  double xx = 0.0, zz = 0.0, xz = 0.0;  ///< Cauchy stress, with water in pores the total one [Pa]
  double hoop = 0.0;                    ///< stress around the axis [Pa]
  double energy = 0.0;                  ///< W, work of the stress [J/m^3 of the present volume]
  double kinetic = 0.0;                 ///< K [J/m^3]
  double free = 0.0;                    ///< free strain, lambda - 1 (tip_physics.hpp)
  double pressure = 0.0;                ///< pressure of water in pores [Pa]
  Vec2 centre{0.0, 0.0};                ///< centre of the material that these are means of [m]

  /// (1 - part) a + part b
  static ContourValues between(const ContourValues& a, const ContourValues& b, double part);
  Vec2 traction(const Vec2& normal) const { return {xx * normal[0] + xz * normal[1], xz * normal[0] + zz * normal[1]}; }
};

enum class ContourField {
  own,    ///< field of the material on the node's own side of the crack
  across  ///< field of the material across the crack whose tip the contour surrounds
};

/// Gives nodal values, say of a grid's or of an exact field.
class ContourSource {
 public:
  virtual ~ContourSource() = default;
  /// True if `field` has material at `node`; then its values are in `values`.
  virtual bool find(const std::array<int, 2>& node, ContourField field, ContourValues& values) const = 0;
};

/// A straight piece of the contour along a grid line.
struct ContourPiece {
  Vec2 from{0.0, 0.0}, to{0.0, 0.0};  ///< [m]
  ContourValues first, last;          ///< at its two ends
  Vec2 normal{0.0, 0.0};              ///< outward, of length 1
  double length() const { return (to - from).norm(); }
};

/// Mean of (u_x,z - u_z,x) / 2 along the contour [1].
double mean_rotation(const std::vector<ContourPiece>& pieces);
/// Mean of (u_x,x + u_z,z) / 2 along the contour [1].
double mean_growth(const std::vector<ContourPiece>& pieces);

/// Lists the pieces of a complete path counter-clockwise, from the face where the path leaves the crack to the face
/// where it comes back.
/// @param at_centres values beside the crack are carried from the centres of their material to the node and the face
/// @return `complete` or `no_material`.
ContourStatus gather_contour(const GridLines& lines, const ContourPath& path, const ContourSource& source,
                             std::vector<ContourPiece>& pieces, bool at_centres = true);

}  // namespace mpm
