#include "mpm/implicit/soil_law.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "mpm/material/drucker_prager.hpp"
#include "mpm/material/mohr_coulomb.hpp"
#include "mpm/math/constants.hpp"

namespace mpm {
namespace {

using mpm_kernel::kLodeSteps;

constexpr double kNoLimit = 1e30;  ///< of tension [Pa]

/// k of drucker_prager.hpp by the sine of three times the Lode angle, 1 in triaxial compression.
double shear_measure(double lode_sine, double sine) {
  const double angle = std::acos(std::clamp(-lode_sine, -1.0, 1.0)) / 3.0, scale = 2.0 / std::sqrt(3.0);
  const double largest = scale * std::cos(angle), smallest = scale * std::cos(angle + 2.0 / 3.0 * kPi);
  return 0.5 * ((largest - smallest) + (largest + smallest) * sine);
}

/// Entries of a table over the Lode angle; the one beyond its end continues it.
template <class Value>
void fill(double (&table)[kLodeSteps + 2], Value&& value) {
  for (int k = 0; k < kLodeSteps + 2; ++k) table[k] = value(std::min(1.0, -1.0 + 2.0 * k / kLodeSteps));
}

/// Strength and slope of soil with these angles and this cohesion, by the Lode angle.
void fill_surface(double friction, double cohesion, double (&strength)[kLodeSteps + 2],
                  double (&slope)[kLodeSteps + 2]) {
  const double sine = std::sin(friction), at_no_pressure = cohesion * std::cos(friction);
  fill(strength, [&](double lode) { return std::sqrt(2.0) * at_no_pressure / shear_measure(lode, sine); });
  fill(slope, [&](double lode) { return std::sqrt(2.0 / 3.0) * sine / shear_measure(lode, sine); });
}

template <class Soil>
mpm_kernel::SoilLaw<double> surface_of(const Soil& d) {
  mpm_kernel::SoilLaw<double> law{};
  const Soil last = d.softening.falls() ? weakened(d, 0.0) : d;
  fill_surface(d.friction_angle, d.cohesion, law.strength, law.slope);
  fill_surface(last.friction_angle, last.cohesion, law.residual_strength, law.residual_slope);
  const double dilation = std::sin(d.dilation_angle);
  fill(law.dilation, [&](double lode) { return std::sqrt(2.0 / 3.0) * dilation / shear_measure(lode, dilation); });
  return law;
}

mpm_kernel::SoilLaw<double> round_cone(const DruckerPragerDefinition& d, double density) {
  const auto cone = [&](const DruckerPragerDefinition& soil, auto& strength, auto& slope) {
    const DruckerPrager matched(soil, density);
    fill(strength, [&](double) { return std::sqrt(2.0) * matched.strength(); });
    fill(slope, [&](double) { return std::sqrt(2.0 / 3.0) * matched.eta(); });
    return matched.eta_bar();
  };
  mpm_kernel::SoilLaw<double> law{};
  const double dilation = cone(d, law.strength, law.slope);
  cone(d.softening.falls() ? weakened(d, 0.0) : d, law.residual_strength, law.residual_slope);
  fill(law.dilation, [&](double) { return std::sqrt(2.0 / 3.0) * dilation; });
  return law;
}

template <class Soil>
void complete(const Soil& d, mpm_kernel::SoilLaw<double>& law) {
  law.least = d.tension_cutoff < 0.0 ? -kNoLimit : -std::sqrt(3.0) * d.tension_cutoff;
  law.compliance_n = 1.0 / (3.0 * d.elasticity.bulk());
  law.compliance_t = 1.0 / (2.0 * d.elasticity.shear());
}

mpm_kernel::SoilLaw<double> law_of(const MaterialDefinition& material) {
  if (const auto* soil = std::get_if<DruckerPragerDefinition>(&material.law)) {
    auto law = soil->match == ConeMatch::mohr_coulomb ? surface_of(*soil) : round_cone(*soil, material.density);
    complete(*soil, law);
    return law;
  }
  const auto* soil = std::get_if<MohrCoulombDefinition>(&material.law);
  if (soil == nullptr) throw MaterialError(refused_implicit(material));
  auto law = surface_of(*soil);
  complete(*soil, law);
  return law;
}

/// What both laws of soil have.
template <class Value>
auto of_soil(const MaterialDefinition& material, Value&& value) {
  if (const auto* soil = std::get_if<DruckerPragerDefinition>(&material.law)) return value(*soil);
  if (const auto* soil = std::get_if<MohrCoulombDefinition>(&material.law)) return value(*soil);
  throw MaterialError(refused_implicit(material));
}

}  // namespace

std::string refused_implicit(const MaterialDefinition& material) {
  if (std::holds_alternative<DruckerPragerDefinition>(material.law)) return {};
  if (std::holds_alternative<MohrCoulombDefinition>(material.law)) return {};
  return fmt::format("method.update: implicit steps are made for soil of drucker_prager and mohr_coulomb, not for '{}' ({}); "
                     "use usavg",
                     material.name, law_name(material.law));
}

ImplicitSoil::ImplicitSoil(const MaterialDefinition& material)
    : density(material.density),
      law(law_of(material)),
      dilation_end(of_soil(material, [](const auto& d) { return d.softening.dilation_limit(d.dilation_limit); })),
      fall(of_soil(material, [](const auto& d) { return d.softening; })) {}

template <class T>
mpm_kernel::SoilLaw<T> ImplicitSoil::law_in() const {
  mpm_kernel::SoilLaw<T> other{};
  for (int k = 0; k < kLodeSteps + 2; ++k) {
    other.strength[k] = static_cast<T>(law.strength[k]);
    other.slope[k] = static_cast<T>(law.slope[k]);
    other.dilation[k] = static_cast<T>(law.dilation[k]);
    other.residual_strength[k] = static_cast<T>(law.residual_strength[k]);
    other.residual_slope[k] = static_cast<T>(law.residual_slope[k]);
  }
  other.least = static_cast<T>(law.least);
  other.compliance_n = static_cast<T>(law.compliance_n);
  other.compliance_t = static_cast<T>(law.compliance_t);
  return other;
}

template mpm_kernel::SoilLaw<double> ImplicitSoil::law_in() const;
template mpm_kernel::SoilLaw<float> ImplicitSoil::law_in() const;

}  // namespace mpm
