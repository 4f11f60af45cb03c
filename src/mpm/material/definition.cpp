#include "mpm/material/definition.hpp"

#include <fmt/core.h>

#include <cmath>

#include "mpm/material/user_law.hpp"
#include "mpm/math/constants.hpp"

namespace mpm {

namespace {

/// Throws unless `holds`. Conditions state what must be true, so that NaN fails them.
void require(bool holds, const MaterialDefinition& material, const std::string& what) {
  if (!holds) throw MaterialError("material '" + material.name + "': " + what);
}

void check(const MaterialDefinition& material, const Elasticity& elasticity) {
  const double young = elasticity.young, poisson = elasticity.poisson;
  require(young > 0.0 && std::isfinite(young), material,
          fmt::format("Young's modulus is {:g} Pa; it must be positive and finite", young));
  require(poisson > -1.0 && poisson < 0.5, material,
          fmt::format("Poisson's ratio is {:g}; it must lie between -1 and 0.5, both excluded", poisson));
}

/// Checks how strength and dilation of a soil fall. Strength that falls faster with strain than the soil unloads would
/// be lost at once whatever the slip: c cos(phi) / G is the elastic shear strain that the loss of cohesion sets free.
/// (What the loss of friction sets free depends on the pressure, which a material does not know.)
template <class SoilDefinition>
void check_softening(const MaterialDefinition& material, const SoilDefinition& law) {
  const SoilSoftening& fall = law.softening;
  require(fall.slip >= 0.0 && std::isfinite(fall.slip), material,
          fmt::format("softening slip is {:g} m; it must be positive and finite", fall.slip));
  require(fall.rise > 0.0, material, fmt::format("dilation rise is {:g} m; it must be positive", fall.rise));
  if (!fall.falls() && std::isinf(fall.rise)) return;
  require(fall.band > 0.0 && std::isfinite(fall.band), material,
          fmt::format("shear band is {:g} m; strength that falls over a slip and dilation that ends at a rise need the "
                      "width of a shear band as the grid resolves it: write the edge of a cell",
                      fall.band));
  if (!fall.falls()) return;
  require(fall.friction_angle >= 0.0 && fall.friction_angle <= law.friction_angle, material,
          fmt::format("residual friction angle is {:g} degrees; it must lie from 0 to the friction angle, {:g}",
                      fall.friction_angle / kDegree, law.friction_angle / kDegree));
  require(fall.cohesion >= 0.0 && fall.cohesion <= law.cohesion, material,
          fmt::format("residual cohesion is {:g} Pa; it must lie from 0 to the cohesion, {:g} Pa", fall.cohesion,
                      law.cohesion));
  require(fall.friction_angle > 0.0 || fall.cohesion > 0.0, material,
          "residual cohesion is 0 Pa and so is the residual friction angle: soil that ends without any strength; give "
          "one of them");
  require(fall.friction_angle < law.friction_angle || fall.cohesion < law.cohesion || law.dilation_angle > 0.0,
          material,
          fmt::format("softening slip is {:g} m, but nothing falls over it; add residual_friction_angle, "
                      "residual_cohesion or a dilation_angle, or leave it out",
                      fall.slip));
  const double lost = law.cohesion * std::cos(law.friction_angle) - fall.cohesion * std::cos(fall.friction_angle);
  const double released = lost / law.elasticity.shear();
  require(fall.strain() > released, material,
          fmt::format("softening slip is {:g} m; over a band of {:g} m cohesion then falls faster than the soil can "
                      "unload: write more than {:.3g} m, or use smaller cells",
                      fall.slip, fall.band, released * fall.band));
}

/// Checks the angles and strengths of a law of soil; `apex` is its name in the text.
template <class SoilDefinition>
void check_soil(const MaterialDefinition& material, const SoilDefinition& law, const char* apex) {
  check(material, law.elasticity);
  const double friction = law.friction_angle, dilation = law.dilation_angle;
  require(friction >= 0.0 && friction < 0.5 * kPi, material,
          fmt::format("friction angle is {:g} degrees; it must lie from 0 to below 90", friction / kDegree));
  require(dilation >= 0.0 && dilation <= friction, material,
          fmt::format("dilation angle is {:g} degrees; it must lie from 0 to the friction angle, {:g}",
                      dilation / kDegree, friction / kDegree));
  require(law.cohesion >= 0.0 && std::isfinite(law.cohesion), material,
          fmt::format("cohesion is {:g} Pa; it must be finite and not negative", law.cohesion));
  require(law.dilation_limit > 0.0, material,
          fmt::format("dilation limit is {:g}; it must be positive", law.dilation_limit));
  require(friction > 0.0 || law.cohesion > 0.0, material,
          "cohesion is 0 Pa and so is the friction angle: soil without any strength; give one of them, or use "
          "newtonian_fluid for a liquid");
  require(std::isfinite(law.tension_cutoff), material,
          fmt::format("tension cut-off is {:g} Pa; it must be finite (negative: {})", law.tension_cutoff, apex));
  // The apex c cot(phi) holds for every match of the cone too (method reference 10.6: xi / eta); without friction there
  // is none.
  if (friction > 0.0) {
    const double largest = law.cohesion / std::tan(friction);
    require(law.tension_cutoff <= largest * (1.0 + 1e-12), material,  // an apex given as the cut-off may be rounded
            fmt::format("tension cut-off is {:g} Pa; it must not lie above {}, cohesion / tan(friction angle) = "
                        "{:g} Pa",
                        law.tension_cutoff, apex, largest));
  }
  check_softening(material, law);
}

void require_positive(double value, const MaterialDefinition& material, const char* constant, const char* unit) {
  require(value > 0.0 && std::isfinite(value), material,
          fmt::format("{} is {:g}{}; it must be positive and finite", constant, value, unit));
}

void require_not_negative(double value, const MaterialDefinition& material, const char* constant, const char* unit) {
  require(value >= 0.0 && std::isfinite(value), material,
          fmt::format("{} is {:g}{}; it must be finite and not negative", constant, value, unit));
}

void check(const MaterialDefinition& material, const MieGrueneisenDefinition& pressure) {
  require_positive(pressure.sound_speed, material, "C0", " m/s");
  require_not_negative(pressure.hugoniot_slope, material, "S", "");
  require_positive(pressure.gamma0, material, "gamma0", "");
}

void check_temperatures(const MaterialDefinition& material, const JohnsonCookDefinition& law) {
  require_positive(law.reference_temperature, material, "reference temperature", " K");
  const double melting = law.melting_temperature;
  require(melting == 0.0 || (melting > law.reference_temperature && std::isfinite(melting)), material,
          fmt::format("melting temperature is {:g} K; it must be finite and above the reference temperature, {:g} K",
                      melting, law.reference_temperature));
}

struct Checker {
  const MaterialDefinition& material;

  void operator()(const LinearElasticDefinition& law) const { check(material, law.elasticity); }
  void operator()(const NeoHookeanDefinition& law) const { check(material, law.elasticity); }
  void operator()(const DruckerPragerDefinition& law) const { check_soil(material, law, "the cone's apex"); }
  void operator()(const MohrCoulombDefinition& law) const { check_soil(material, law, "the apex"); }
  void operator()(const MuIDefinition& law) const {
    check(material, law.elasticity);
    require_positive(law.static_friction, material, "mu_s", "");
    require(law.limiting_friction >= law.static_friction && law.limiting_friction < 1.0, material,
            fmt::format("mu_2 is {:g}; it must lie from mu_s, {:g}, to below 1, where no stress in a plane makes the "
                        "grain flow",
                        law.limiting_friction, law.static_friction));
    require_positive(law.reference_inertial, material, "I_0", "");
    require_positive(law.grain_diameter, material, "grain diameter", " m");
    require_positive(law.grain_density, material, "grain density", " kg/m^3");
    require(law.grain_density >= material.density, material,
            fmt::format("grain density is {:g} kg/m^3; it must not be below that of the heap, {:g}", law.grain_density,
                        material.density));
  }
  void operator()(const CamClayDefinition& law) const {
    require_positive(law.kappa, material, "kappa", "");
    require(law.lambda > law.kappa && std::isfinite(law.lambda), material,
            fmt::format("lambda is {:g}; it must be finite and above kappa, {:g}", law.lambda, law.kappa));
    require(law.slope > 0.0 && law.slope < 3.0, material,
            fmt::format("M is {:g}; it must lie above 0 and below 3, where no stress makes the clay flow", law.slope));
    require_positive(law.void_ratio, material, "void ratio", "");
    require(law.poisson > -1.0 && law.poisson < 0.5, material,
            fmt::format("Poisson's ratio is {:g}; it must lie between -1 and 0.5, both excluded", law.poisson));
    require_not_negative(law.shear_modulus, material, "shear modulus", " Pa");
    require_positive(law.least_pressure, material, "least pressure", " Pa");
    require_not_negative(law.consolidation, material, "preconsolidation pressure", " Pa");
    require(law.consolidation > 0.0 || (law.overconsolidation >= 1.0 && std::isfinite(law.overconsolidation)), material,
            fmt::format("overconsolidation ratio is {:g}; it must be finite and at least 1", law.overconsolidation));
  }
  void operator()(const NorSandDefinition& law) const {
    require_positive(law.gamma, material, "gamma", "");
    require_positive(law.lambda, material, "lambda", "");
    require(law.critical_exponent >= 0.0 && law.critical_exponent <= 1.0, material,
            fmt::format("critical exponent is {:g}; it must lie above 0 and not above 1", law.critical_exponent));
    require(law.slope > 0.0 && law.slope < 2.0, material,
            fmt::format("M is {:g}; it must lie above 0 and below 2, a friction angle of 49 degrees", law.slope));
    require(law.coupling >= 0.0 && law.coupling < 1.0, material,
            fmt::format("N is {:g}; it must lie from 0 to below 1", law.coupling));
    require_positive(law.dilatancy, material, "chi", "");
    require(law.dilatancy * law.critical_slope() < 0.5 * law.slope, material,
            fmt::format("chi is {:g}; chi times the slope of the critical line, {:g}, must be below half of M, {:g}",
                        law.dilatancy, law.critical_slope(), law.slope));
    require_positive(law.hardening, material, "H", "");
    require_not_negative(law.hardening_of_state, material, "H psi", "");
    require_positive(law.shear_modulus, material, "shear modulus", " Pa");
    require(law.shear_exponent >= 0.0 && law.shear_exponent <= 0.9, material,
            fmt::format("shear exponent is {:g}; it must lie from 0 to 0.9", law.shear_exponent));
    require(law.poisson > -1.0 && law.poisson < 0.4, material,
            fmt::format("Poisson's ratio is {:g}; it must lie between -1 and 0.4, both excluded", law.poisson));
    require_positive(law.void_ratio, material, "void ratio", "");
    require(law.overconsolidation >= 1.0 && std::isfinite(law.overconsolidation), material,
            fmt::format("overconsolidation ratio is {:g}; it must be finite and at least 1", law.overconsolidation));
    require_positive(law.least_pressure, material, "least pressure", " Pa");
  }
  void operator()(const J2PlasticityDefinition& law) const {
    check(material, law.elasticity);
    require_positive(law.yield_stress, material, "yield stress", " Pa");
    require_not_negative(law.hardening_modulus, material, "hardening modulus", " Pa");
    require_not_negative(law.saturation_rate, material, "saturation rate", "");
    if (law.saturation_rate > 0.0) {
      require(law.saturation_stress >= law.yield_stress && std::isfinite(law.saturation_stress), material,
              fmt::format("saturation stress is {:g} Pa; it must be finite and not below the yield stress, {:g} Pa",
                          law.saturation_stress, law.yield_stress));
    }
  }
  void operator()(const NewtonianFluidDefinition& law) const {
    require_positive(law.bulk_modulus, material, "bulk modulus", " Pa");
    require(law.exponent >= 1.0 && std::isfinite(law.exponent), material,
            fmt::format("exponent is {:g}; it must be finite and at least 1", law.exponent));
    require_not_negative(law.viscosity, material, "viscosity", " Pa s");
  }
  void operator()(const IdealGasDefinition& law) const {
    require_positive(law.pressure, material, "pressure", " Pa");
    require(law.temperature > 0.0 && std::isfinite(law.temperature), material,
            fmt::format("temperature is {:g} K; it is absolute and must be positive and finite", law.temperature));
    require(law.heat_capacity_ratio > 1.0 && std::isfinite(law.heat_capacity_ratio), material,
            fmt::format("heat capacity ratio is {:g}; it must be finite and above 1", law.heat_capacity_ratio));
    require_not_negative(law.ambient, material, "ambient pressure", " Pa");
  }
  void operator()(const UserLawDefinition& law) const {
    require(law.kind != nullptr, material, "no law is named; add one by add_user_law() and name its kind");
    check(material, law.elasticity);
    require(law.constants.size() == law.kind->constants.size(), material,
            fmt::format("found {} constants; '{}' has {}", law.constants.size(), law.kind->name,
                        law.kind->constants.size()));
    for (std::size_t i = 0; i < law.constants.size(); ++i) {
      require(std::isfinite(law.constants[i]), material, fmt::format("{} is not finite", law.kind->constants[i].key));
    }
  }
  void operator()(const StandardLinearSolidDefinition& law) const {
    check(material, law.elasticity);
    require_positive(law.branch_modulus, material, "branch modulus", " Pa");
    require_positive(law.relaxation_time, material, "relaxation time", " s");
  }
  void operator()(const JohnsonCookDefinition& law) const {
    require_positive(law.shear_modulus, material, "shear modulus", " Pa");
    check(material, law.pressure);
    require_positive(law.yield_stress, material, "A", " Pa");
    require_not_negative(law.hardening, material, "B", " Pa");
    require(law.hardening_exponent > 0.0 && law.hardening_exponent <= 1.0, material,
            fmt::format("n is {:g}; it must lie above 0 and not above 1", law.hardening_exponent));
    require_not_negative(law.rate_sensitivity, material, "C", "");
    require_positive(law.reference_rate, material, "reference rate", " 1/s");
    require_positive(law.softening_exponent, material, "m", "");
    check_temperatures(material, law);
    require_positive(law.heat_capacity, material, "heat capacity", " J/(kg K)");
    require(law.heat_fraction >= 0.0 && law.heat_fraction <= 1.0, material,
            fmt::format("heat fraction is {:g}; it must lie from 0 to 1", law.heat_fraction));
  }
};

template <class Definition>
auto elasticity_in(const Definition& d, int) -> decltype(std::optional<Elasticity>(d.elasticity)) {
  return d.elasticity;
}
template <class Definition>
std::optional<Elasticity> elasticity_in(const Definition&, long) {
  return std::nullopt;
}
template <class Definition>
auto friction_in(const Definition& d, int) -> decltype(std::optional<double>(d.friction_angle)) {
  return d.friction_angle;
}
template <class Definition>
std::optional<double> friction_in(const Definition&, long) {
  return std::nullopt;
}

}  // namespace

void check(const MaterialDefinition& material) {
  if (material.name.empty()) throw MaterialError("material without a name; give it one");
  require(material.density > 0.0 && std::isfinite(material.density), material,
          fmt::format("density is {:g} kg/m^3; it must be positive and finite", material.density));
  std::visit(Checker{material}, material.law);
}

std::optional<Elasticity> elasticity_of(const LawDefinition& law) {
  return std::visit([](const auto& own) { return elasticity_in(own, 0); }, law);
}

std::optional<double> friction_angle(const LawDefinition& law) {
  if (std::holds_alternative<J2PlasticityDefinition>(law)) return 0.0;
  return std::visit([](const auto& own) { return friction_in(own, 0); }, law);
}

std::string law_name(const LawDefinition& law) {
  if (const auto* own = std::get_if<UserLawDefinition>(&law)) return own->kind->name;
  return std::visit([](const auto& own) { return own.kName; }, law);
}

}  // namespace mpm
