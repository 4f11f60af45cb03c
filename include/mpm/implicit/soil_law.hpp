// Soil as the implicit step sees it: cone, flow and elasticity of a material's definition.
//
// Strength is that of the explicit law (drucker_prager.hpp, mohr_coulomb.hpp): a round cone, or Mohr-Coulomb's surface
// in invariants, sqrt(J2) k(phi) <= c cos(phi) + p sin(phi) with the k of the Lode angle (kernel/soil_cells.hpp). Flow
// is radial in the deviatoric plane; dilation ends and strength falls as in the explicit laws (softening.hpp). The
// strength of j2_plasticity is a cohesion, sigma_y / sqrt(3), of the plastic strain at the step's start; that of mu_i
// is a round cone whose slope follows the rate of the step itself (mu_i.hpp).
//
// Weak: for mohr_coulomb flow has no corners, and its tension limit is one of the mean stress, as for drucker_prager.
// Metal yields on its Cauchy stress, where the explicit law has that times J.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mpm/kernel/soil_cells.hpp"
#include "mpm/material/definition.hpp"
#include "mpm/material/softening.hpp"

namespace mpm {

/// Reason why a material cannot take implicit steps, and what can be used instead; empty when it can.
std::string refused_implicit(const MaterialDefinition& material);

struct ImplicitSoil {
  /// @throws MaterialError for a material that refused_implicit() names
  explicit ImplicitSoil(const MaterialDefinition& material);

  /// For the cells, whose cohesion follows the fall of strength that is left, or the plastic strain of metal
  /// (kernel/soil_cell.hpp).
  mpm_kernel::SoilConstants constants() const;

  /// Largest Mises stress of metal that is not hardened in a straight line [Pa]; 0 of soil.
  double yield_stress = 0.0;
  double density = 0.0;            ///< [kg/m^3]
  double bulk = 0.0, shear = 0.0;  ///< moduli [Pa]
  Fall sine;                       ///< sin(phi), or eta of a round cone
  double dilation = 0.0;           ///< sin(psi), or eta_bar
  bool follows_lode = false;       ///< false for a round cone
  double least = 0.0;              ///< r_N at which it parts: minus sqrt(3) times the mean tension that it bears [Pa]
  double dilation_start = 1.0, dilation_slope = 0.0;  ///< DilationEnd
  double per_strain = 0.0;                            ///< change of `left`, downwards, by plastic strain
  double friction_rise = 0.0;                         ///< mu_2 - mu_s; 0: no part of the strength is viscous
  double reference_rate = 0.0;                        ///< for I_0, over sqrt(p) [1/(s sqrt(Pa))]
  // Places where particles store what a step changes, and the law's plastic strain over |e_T|.
  int strain_at = 0, work_at = 0;
  std::optional<int> opening_at;  ///< none: pressure is that of the volume, and so is what it does not account for
  double strain_of_shear = 0.0;

 private:
  Fall cohesion_;
  std::optional<J2PlasticityDefinition> metal_;
};

/// Least and largest numbers of the soils of a scene.
struct SoilRange {
  explicit SoilRange(const std::vector<ImplicitSoil>& soils);
  double least_density = 0.0;  ///< initial [kg/m^3]
  double modulus = 0.0;        ///< largest constrained modulus of soils, of metals where there is nothing else [Pa]
  double metal_modulus = 0.0, yield_stress = 0.0;  ///< the same, and the largest yield stress, of metals [Pa]
};

}  // namespace mpm
