// Soil as the implicit step sees it: cone, flow and elasticity of a material's definition.
//
// Strength is that of the explicit law (drucker_prager.hpp, mohr_coulomb.hpp): a round cone, or Mohr-Coulomb's surface
// in invariants, sqrt(J2) k(phi) <= c cos(phi) + p sin(phi) with the k of the Lode angle (kernel/soil_cells.hpp). Flow
// is radial in the deviatoric plane; dilation ends and strength falls as in the explicit laws (softening.hpp).
//
// Weak: for mohr_coulomb flow has no corners, and its tension limit is one of the mean stress, as for drucker_prager.
#pragma once

#include <string>

#include "mpm/material/definition.hpp"
#include "mpm/material/opening.hpp"
#include "mpm/material/softening.hpp"

namespace mpm {

/// Why a material cannot take implicit steps, and what can be used instead; empty when it can.
std::string refused_implicit(const MaterialDefinition& material);

struct ImplicitSoil {
  /// @throws MaterialError for a material that refused_implicit() names
  explicit ImplicitSoil(const MaterialDefinition& material);

  double density;      ///< [kg/m^3]
  double bulk, shear;  ///< moduli [Pa]
  /// sin(phi) and c cos(phi) [Pa]; of a round cone eta and xi c, which fall in the same way.
  Fall sine, cohesion;
  double dilation;    ///< sin(psi), or eta_bar
  bool follows_lode;  ///< false for a round cone
  double least;       ///< r_N at which it parts: minus sqrt(3) times the mean tension that it bears [Pa]
  DilationEnd dilation_end;
  StrengthFall fall;
};

}  // namespace mpm
