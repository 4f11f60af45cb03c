// Constants of an isotropic elastic material that the field near a crack's tip needs: moduli of the plane, wave speeds,
// and the factors of a tip that runs at a constant speed. Strains are small; a material that is not isotropic, or lies
// on one side of the crack only, has no such constants, and a tip in it has J but no stress intensities.
// Source: crack reference 4.7; Freund (1990), Dynamic fracture mechanics, chapter 4.
#pragma once

#include <optional>

#include "mpm/material/definition.hpp"
#include "mpm/math/geometry_kind.hpp"

namespace mpm {

struct ElasticConstants {
  double youngs = 0.0;   ///< E [Pa]
  double poisson = 0.0;  ///< nu; above -1, at most 0.5, and below 0.5 for what has the factor 1/(kappa - 1)
  double density = 0.0;  ///< [kg/m^3]; 0 stands for a tip at rest: waves are infinitely fast
  bool plane_stress = false;

  /// Plane stress for that geometry; plane strain for all others, also about an axis.
  static ElasticConstants of(double youngs, double poisson, double density, GeometryKind geometry) {
    return {youngs, poisson, density, geometry == GeometryKind::plane_stress};
  }

  /// E' [Pa]: E, in plane strain E / (1 - nu^2).
  double plane_modulus() const { return plane_stress ? youngs : youngs / (1.0 - poisson * poisson); }
  /// G [Pa]
  double shear_modulus() const { return 0.5 * youngs / (1.0 + poisson); }
  /// Kolosov's constant: (3 - nu) / (1 + nu), in plane strain 3 - 4 nu.
  double kappa() const { return plane_stress ? (3.0 - poisson) / (1.0 + poisson) : 3.0 - 4.0 * poisson; }

  /// Speed of waves of pressure in the plane [m/s]; infinite for density 0.
  double dilatational_speed() const;
  /// Speed of shear waves [m/s]; infinite for density 0.
  double shear_speed() const;
  /// Speed of surface waves, the limit of an opening tip's speed [m/s]; infinite for density 0.
  double rayleigh_speed() const;
};

/// Constants of a material whose stress intensities follow from J: isotropic, elastic but for what yields near the tip;
/// none of other materials.
std::optional<ElasticConstants> elastic_constants_of(const MaterialDefinition& material, GeometryKind geometry);

/// Factors of a tip that runs at a constant speed. At rest both factors of energy are (kappa + 1) / 4.
struct RunningTip {
  bool possible = true;         ///< false from the speed of surface waves on, where no energy flows into the tip
  double beta_d = 1.0;          ///< sqrt(1 - c^2 / c_d^2)
  double beta_s = 1.0;          ///< sqrt(1 - c^2 / c_s^2)
  double one = 0.0, two = 0.0;  ///< A_I, A_II of the release rate (A_I K_I^2 + A_II K_II^2) / (2 G)
};
/// `speed` [m/s], at least 0. The factors have no cancellation near 0 and need no case of their own there.
RunningTip running_tip(const ElasticConstants& constants, double speed);

}  // namespace mpm
