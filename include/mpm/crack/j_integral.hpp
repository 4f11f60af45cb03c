// The J integral around the tip of a crack, energy released by area of new crack, as a vector J_k in the plane
// [J/m^2]: the integral along a contour, and that over the area inside, which counts where material accelerates and
// always about an axis.
//
//   J_k = int [(W + K) n_k - sigma_ij n_j u_i,k] ds + int rho (a_i u_i,k - v_i v_i,k) dA
//         + the area term of the axis + the terms of faces (face_terms.hpp)
//
// About an axis it is by length of the crack's front, in one of two forms that give the same J. At large strain the
// contour lies in the deformed body, derivatives are those by undeformed coordinates, and J is by undeformed area:
//   J_k = int [w (F^T n)_k - (sigma n)_i (F - I)_ik] ds.
//
// The form of Bergkvist and Huong takes the first moment of energy about the tip from particles, of which those next to
// the tip have it wrong: by up to 0.2 cells times J, 2 % of J at a radius of 10 cells. In a square around the tip it is
// taken from the square's edge, by
//   int_A (F_kr - r q_k) dA = int (r - a) F_kj n_j ds - a int_A q_k dA,  F_kj n_j the flux, q_k Broberg's area density,
// which is the form of Broberg there, carried on to the contour by that of Bergkvist and Huong.
//
// In the plane the mean rotation along the contour is taken off the gradients on which tractions and inertia work. By
// the balance of momentum it adds nothing; but where a body turns far more than it strains, as beams do, its error of
// quadrature was 3 to 6 % of J.
//
// Free strains and water in pores have an area term of their own (tip_physics.hpp). There the mean growth along the
// contour is taken off the gradients too, for the same reason: a free strain may be far larger than that of the load.
//
// Weak: trapezoidal rule, with exact nodal values 1.4 % low for contours of two cells around the nearest node, 0.6 %
// for three (test/unit/crack_j_integral_test.cpp). The area is summed over particles, scaled to fill the rectangle.
// Source: crack reference 4.1 to 4.3, 4.6; Bergkvist and Huong (1977), Broberg (1987) about an axis. The form of J_z
// by Broberg has an area term of its own that NairnMPM leaves out.
#pragma once

#include <vector>

#include "mpm/crack/contour_values.hpp"

namespace mpm {

/// Choice of the integral.
struct JForm {
  enum class Kind { planar, broberg, bergkvist_huong };
  Kind kind = Kind::planar;
  double tip_radius = 0.0;    ///< radius of bergkvist_huong [m]; at large strain that of the undeformed body
  bool large_strain = false;  ///< gradients are F - I, energies are by present volume
  double rotation = 0.0;      ///< [1] taken off (u_x,z - u_z,x) / 2 of what tractions and inertia work on
  double growth = 0.0;        ///< [1] taken off u_x,x and u_z,z of the same
  double content = 0.0;       ///< [1] mean water content, whose pressure the contour carries (tip_physics.hpp)
  Vec2 low{0.0, 0.0};         ///< corners, for bergkvist_huong, of a square where the form of Broberg holds [m]
  Vec2 high{0.0, 0.0};

  bool about_axis() const { return kind != Kind::planar; }
  Kind kind_at(const Vec2& place) const {
    const bool inside = (place.array() >= low.array()).all() && (place.array() < high.array()).all();
    return kind == Kind::bergkvist_huong && inside ? Kind::broberg : kind;
  }
};

/// Factor of a term per length or area at a place: 1, but r / a in the form of Bergkvist and Huong, and in that of
/// Broberg at large strain r / R.
double weight_of(const JForm& form, const Vec2& place, const ContourValues& values);

/// (W + K) n_k - t_i u_i,k, or its form of large strain, without the weight [J/m^2]; t is the traction there [Pa].
Vec2 energy_flux(const JForm& form, const ContourValues& values, const Vec2& normal, const Vec2& traction);

/// The integral along the contour [J/m^2].
Vec2 contour_term(const JForm& form, const std::vector<ContourPiece>& pieces);

/// Along the edge of the square of `form`, what joins the form of Broberg inside it to that outside [J/m^2].
Vec2 joining_term(const JForm& form, const std::vector<ContourPiece>& edge);

/// A particle inside the contour. Those of bodies that ignore the crack are left out.
struct AreaSample {
  Vec2 place{0.0, 0.0};                 ///< [m]
  double area = 0.0;                    ///< in the plane [m^2]
  double density = 0.0;                 ///< density of the present volume [kg/m^3]
  Vec2 acceleration{0.0, 0.0};          ///< [m/s^2]
  Vec2 velocity{0.0, 0.0};              ///< [m/s]
  double velocity_gradient[2][2] = {};  ///< v_i,k by present coordinates [1/s]
  ContourValues values;
  /// Derivatives of the energy by its explicit place: (sigma'_ii - 3 Psi) lambda,k / lambda [J/m^4].
  Vec2 free_force{0.0, 0.0};
  double content = 0.0;              ///< water that the volume has taken in, zeta [1]
  Vec2 pressure_slope{0.0, 0.0};     ///< [Pa/m]
  Vec2 eigenstrain_slope{0.0, 0.0};  ///< slope of what stress intensities feel as a free strain [1/m]
};

/// Mean content by area; 0 without samples.
double mean_content(const std::vector<AreaSample>& samples);

/// The integral over an area [m^2] that the samples fill [J/m^2]; 0 without samples. `inertia`: with accelerations.
Vec2 area_term(const JForm& form, const std::vector<AreaSample>& samples, double area, bool inertia = true);

/// J at a tip and what it is made of [J/m^2].
struct JResult {
  ContourStatus status = ContourStatus::meets_no_crack;  ///< else than `complete`: all else is 0
  Vec2 contour{0.0, 0.0};                                ///< the integral along the contour
  Vec2 area{0.0, 0.0};                                   ///< that over the area inside
  Vec2 faces{0.0, 0.0};                                  ///< to add for faces inside: face_term()
  double faces_work = 0.0;  ///< to take off for tractions on this crack's faces: traction_work(), friction_work()
  ContourCrossing crossing;
  double rotation = 0.0;  ///< JForm::rotation of these integrals; zero with `inertia` left out and about an axis
  double growth = 0.0;    ///< JForm::growth of them; zero without free strain or pressure too

  Vec2 j() const { return contour + area + faces; }
  /// J of growth along a unit vector, without the work that tractions on the faces take up.
  double along(const Vec2& direction) const { return j().dot(direction) - faces_work; }
};

/// Contour and area of a tip: gathers the values of a path into `pieces` and integrates them.
/// @param samples particles inside the path; empty: without the area.
/// @param swells the body has free strains or water in pores
JResult integrate_j(JForm form, const GridLines& lines, const ContourPath& path, const ContourSource& source,
                    const std::vector<AreaSample>& samples, bool inertia, std::vector<ContourPiece>& pieces,
                    bool swells = false);

}  // namespace mpm
