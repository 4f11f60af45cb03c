// The definition of a material in a scene: density and a law with its constants, in SI. The constants are checked when
// a law is made from it.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "mpm/math/error.hpp"

namespace mpm {

// The laws; each has the class of this name in a file of its own. A definition names its law, and has the name that
// scenes give to it.
class CamClay;
class DruckerPrager;
class IdealGas;
class J2Plasticity;
class JohnsonCook;
class LinearElastic;
class MohrCoulomb;
class MuI;
class NeoHookean;
class NewtonianFluid;
class NorSand;
class StandardLinearSolid;
class UserLaw;
struct UserLawKind;

/// Thrown for constants outside their range.
class MaterialError : public Error {
 public:
  using Error::Error;
};

/// Isotropic elasticity: Young's modulus [Pa] > 0 and Poisson's ratio in (-1, 0.5).
struct Elasticity {
  double young = 0.0;
  double poisson = 0.0;
  double bulk() const { return young / (3.0 * (1.0 - 2.0 * poisson)); }
  double shear() const { return young / (2.0 * (1.0 + poisson)); }
};

/// Linear hypoelasticity: the objective (Jaumann) rate of Cauchy stress.
struct LinearElasticDefinition {
  using Law = LinearElastic;
  static constexpr const char* kName = "linear_elastic";
  Elasticity elasticity;
};

struct NeoHookeanDefinition {
  using Law = NeoHookean;
  static constexpr const char* kName = "neo_hookean";
  Elasticity elasticity;
};

/// States where Drucker-Prager has Mohr-Coulomb's strength and dilation: in every state, since the slope follows the
/// Lode angle, or in the state through which a round cone passes.
enum class ConeMatch { mohr_coulomb, plane_strain, compression, extension };

/// Dense sand shears at constant volume once it has gained about a tenth (critical state): between the densest and the
/// loosest packing of most sands there is a fifth.
constexpr double kDilationLimit = 0.1;

/// Loss of strength and dilation of soil along a shear band, to its critical state: over displacements of the band,
/// which are strains of the band as the grid resolves it (softening.hpp); angles in radians.
struct SoilSoftening {
  double slip = 0.0;            ///< displacement along the band over which strength falls [m], > 0; 0: it does not fall
  double band = 0.0;            ///< width of a band as the grid resolves it, the edge of a cell [m], > 0
  double friction_angle = 0.0;  ///< residual [rad], in [0, peak]
  double cohesion = 0.0;        ///< residual [Pa], in [0, peak]
  /// Displacement across the band, the thickness that it gains, at which dilation ends [m], > 0; infinite: at none.
  double rise = std::numeric_limits<double>::infinity();
  bool falls() const { return slip > 0.0; }
  double strain() const { return slip / band; }  ///< plastic shear strain over which strength falls
  /// Volume gained over initial volume at which dilation ends: where the band has risen, or at `limit`, which the state
  /// of the soil sets, if that is less; so it is on a grid finer than the band in the soil.
  double dilation_limit(double limit) const { return std::min(limit, rise / band); }
};

/// A band of sand is some 10 to 20 grains wide, 10 mm, and gains a tenth (kDilationLimit). [m]
constexpr double kDilationRise = 1e-3;

/// Drucker-Prager soil; angles in radians.
struct DruckerPragerDefinition {
  using Law = DruckerPrager;
  static constexpr const char* kName = "drucker_prager";
  Elasticity elasticity;
  double friction_angle = 0.0;   ///< [rad], in [0, pi/2)
  double dilation_angle = 0.0;   ///< [rad], in [0, friction_angle]
  double cohesion = 0.0;         ///< [Pa], >= 0
  double tension_cutoff = -1.0;  ///< largest mean tension [Pa]; -1: the cone's apex
  ConeMatch match = ConeMatch::mohr_coulomb;
  double dilation_limit = kDilationLimit;  ///< most volume gained, over initial volume, at which dilation ends, > 0
  SoilSoftening softening = {};
};

/// Mohr-Coulomb soil; angles in radians.
struct MohrCoulombDefinition {
  using Law = MohrCoulomb;
  static constexpr const char* kName = "mohr_coulomb";
  Elasticity elasticity;
  double friction_angle = 0.0;             ///< [rad], in [0, pi/2)
  double dilation_angle = 0.0;             ///< [rad], in [0, friction_angle]
  double cohesion = 0.0;                   ///< [Pa], >= 0
  double tension_cutoff = -1.0;            ///< largest principal tension [Pa]; -1: the apex
  double dilation_limit = kDilationLimit;  ///< as above
  SoilSoftening softening = {};
};

/// Dry grain that flows at the rate-dependent friction mu(I) = mu_s + (mu_2 - mu_s) / (I_0 / I + 1), I = rate d /
/// sqrt(p / rho_s).
struct MuIDefinition {
  using Law = MuI;
  static constexpr const char* kName = "mu_i";
  Elasticity elasticity;
  double static_friction = 0.0;     ///< mu_s, > 0
  double limiting_friction = 0.0;   ///< mu_2, from mu_s to below 1
  double reference_inertial = 0.0;  ///< I_0, > 0
  double grain_diameter = 0.0;      ///< d [m], > 0
  double grain_density = 0.0;       ///< rho_s, of the grains themselves [kg/m^3], > 0
};

/// Modified Cam clay: soft soil between the lines v = N - lambda ln p and v = v_k - kappa ln p, flowing in the end at q
/// = M p. Of shear_modulus and poisson one is used, and of consolidation and overconsolidation.
struct CamClayDefinition {
  using Law = CamClay;
  static constexpr const char* kName = "cam_clay";
  double lambda = 0.0;             ///< slope of first compression over ln p, > kappa
  double kappa = 0.0;              ///< slope of swelling over ln p, > 0
  double slope = 0.0;              ///< M, > 0
  double void_ratio = 0.0;         ///< at the start, over the volume of the grains, > 0
  double shear_modulus = 0.0;      ///< G [Pa], > 0; 0: from Poisson's ratio
  double poisson = 0.0;            ///< in (-1, 0.5)
  double consolidation = 0.0;      ///< p_c, the largest pressure that the clay has carried [Pa], > 0; 0: from the ratio
  double overconsolidation = 0.0;  ///< size of the surface over that through the initial stress, >= 1; 0: unused
  double least_pressure = 0.0;     ///< p_r of K = v (p + p_r) / kappa [Pa], > 0
  double shear_over_bulk() const { return 1.5 * (1.0 - 2.0 * poisson) / (1.0 + poisson); }
};

/// NorSand: sand that becomes stronger, stiffer and more dilatant with density, and less dilatant with pressure.
struct NorSandDefinition {
  using Law = NorSand;
  static constexpr const char* kName = "norsand";
  double gamma = 0.0;               ///< void ratio of the critical state at 1 kPa; with an exponent, without pressure
  double lambda = 0.0;              ///< its fall over ln p, or over (p / 100 kPa)^exponent, > 0
  double critical_exponent = 0.0;   ///< xi, in (0, 1]; 0: the logarithm
  double slope = 0.0;               ///< M in triaxial compression, > 0
  double coupling = 0.0;            ///< N, in [0, 1)
  double dilatancy = 0.0;           ///< chi: largest dilation over the state parameter at the peak, > 0
  double hardening = 0.0;           ///< H_0, > 0
  double hardening_of_state = 0.0;  ///< H_psi, >= 0: H = H_0 - H_psi psi, at least half of H_0
  double shear_modulus = 0.0;       ///< G at 100 kPa [Pa], > 0
  double shear_exponent = 0.5;      ///< n of G over pressure, in [0, 0.9]
  double poisson = 0.2;             ///< in (-1, 0.5)
  double void_ratio = 0.0;          ///< at the start, > 0
  double overconsolidation = 1.0;   ///< size of the surface over that through the initial stress, >= 1
  double least_pressure = 100.0;    ///< p_r, below which the sand softens no more [Pa], > 0
  double shear_over_bulk() const { return 1.5 * (1.0 - 2.0 * poisson) / (1.0 + poisson); }
  /// Slope of the critical line over ln p, at 100 kPa.
  double critical_slope() const { return critical_exponent > 0.0 ? lambda * critical_exponent : lambda; }
  /// chi_i: chi over the state parameter at the image pressure.
  double image_dilatancy() const { return dilatancy / (1.0 - dilatancy * critical_slope() / slope); }
};

/// Metal with isotropic hardening: flow stress yield + H a + (saturation - yield) (1 - exp(-rate a)) at plastic strain
/// a.
struct J2PlasticityDefinition {
  using Law = J2Plasticity;
  static constexpr const char* kName = "j2_plasticity";
  Elasticity elasticity;
  double yield_stress = 0.0;       ///< Mises stress at first yield [Pa], > 0
  double hardening_modulus = 0.0;  ///< H [Pa], >= 0
  double saturation_stress = 0.0;  ///< [Pa], >= yield_stress; unused when saturation_rate is 0
  double saturation_rate = 0.0;    ///< [-], >= 0
};

/// Pressure of a solid under shock, from the shock speed C0 + S u_p at particle speed u_p.
struct MieGrueneisenDefinition {
  double sound_speed = 0.0;     ///< C0 [m/s], > 0
  double hugoniot_slope = 0.0;  ///< S, >= 0
  double gamma0 = 0.0;          ///< Grueneisen's constant at rho0, > 0
};

/// Metal under impact: flow stress (A + B a^n) (1 + C ln(rate/reference_rate)) (1 - T*^m) at plastic strain a, with T*
/// = (T - reference_temperature) / (melting_temperature - reference_temperature).
struct JohnsonCookDefinition {
  using Law = JohnsonCook;
  static constexpr const char* kName = "johnson_cook";
  double shear_modulus = 0.0;  ///< [Pa], > 0
  MieGrueneisenDefinition pressure;
  double yield_stress = 0.0;             ///< A [Pa], > 0
  double hardening = 0.0;                ///< B [Pa], >= 0
  double hardening_exponent = 1.0;       ///< n, in (0, 1]
  double rate_sensitivity = 0.0;         ///< C, >= 0
  double reference_rate = 1.0;           ///< [1/s], > 0; slower flow has the strength at this rate
  double softening_exponent = 1.0;       ///< m, > 0
  double melting_temperature = 0.0;      ///< [K], > reference_temperature, or 0 for no softening and no melting
  double reference_temperature = 293.0;  ///< [K], > 0; initial temperature unless a body has its own
  double heat_capacity = 0.0;            ///< c_v [J/(kg K)], > 0
  double heat_fraction = 0.9;            ///< part of the plastic work that becomes heat, in [0, 1]
};

/// Fluid with Tait's equation p = K/n (J^-n - 1) and Newtonian viscosity.
struct NewtonianFluidDefinition {
  using Law = NewtonianFluid;
  static constexpr const char* kName = "newtonian_fluid";
  double bulk_modulus = 0.0;  ///< K [Pa], > 0
  double exponent = 7.0;      ///< n, >= 1
  double viscosity = 0.0;     ///< dynamic, shear [Pa s], >= 0
  bool tension = false;       ///< true if pressure may be negative
};

enum class GasProcess { adiabatic, isothermal };

/// Ideal gas: p = p0 (T/T0) / J.
struct IdealGasDefinition {
  using Law = IdealGas;
  static constexpr const char* kName = "ideal_gas";
  double pressure = 0.0;             ///< p0, at the material's density and T0 [Pa], > 0
  double temperature = 0.0;          ///< T0, absolute [K], > 0
  double heat_capacity_ratio = 1.4;  ///< > 1
  GasProcess process = GasProcess::adiabatic;
  double ambient = 0.0;  ///< pressure of the surroundings, which stress is relative to [Pa], >= 0
};

/// Neo-Hookean solid with the long-term constants, parallel to a Maxwell branch.
struct StandardLinearSolidDefinition {
  using Law = StandardLinearSolid;
  static constexpr const char* kName = "viscoelastic";
  Elasticity elasticity;         ///< long-term
  double branch_modulus = 0.0;   ///< shear modulus of the branch's spring [Pa], > 0
  double relaxation_time = 0.0;  ///< time of the branch [s], > 0
};

/// A law that a program has added (user_law.hpp).
struct UserLawDefinition {
  using Law = UserLaw;
  static constexpr const char* kName = "law of a user";
  const UserLawKind* kind = nullptr;
  Elasticity elasticity;          ///< stiffness at small strain
  std::vector<double> constants;  ///< values of UserLawKind::constants [SI]
  /// @throws MaterialError for a key that the law does not have
  double constant(const std::string& key) const;
};

using LawDefinition =
    std::variant<LinearElasticDefinition, NeoHookeanDefinition, DruckerPragerDefinition, MohrCoulombDefinition,
                 J2PlasticityDefinition, NewtonianFluidDefinition, IdealGasDefinition, StandardLinearSolidDefinition,
                 JohnsonCookDefinition, MuIDefinition, CamClayDefinition, NorSandDefinition, UserLawDefinition>;

struct MaterialDefinition {
  std::string name;
  double density = 0.0;  ///< initial [kg/m^3], > 0
  LawDefinition law;
};

/// Checks all constants. @throws MaterialError naming the constant, its value and its range.
void check(const MaterialDefinition& material);
/// The law's name in scenes, such as "neo_hookean".
std::string law_name(const LawDefinition& law);
/// Young's modulus and Poisson's ratio of a law that has them; of a viscoelastic one those of long times.
std::optional<Elasticity> elasticity_of(const LawDefinition& law);
/// Friction angle [rad] of a law that flows in shear at a strength of Coulomb's kind; 0 where the strength does not
/// follow the pressure.
std::optional<double> friction_angle(const LawDefinition& law);

}  // namespace mpm
