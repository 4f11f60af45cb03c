#include "mpm/implicit/soil_law.hpp"

#include <fmt/core.h>

#include <cmath>
#include <variant>

#include "mpm/material/drucker_prager.hpp"

namespace mpm {
namespace {

constexpr double kNoLimit = 1e30;  ///< of tension [Pa]

/// What both laws of soil have.
template <class Value>
auto of_soil(const MaterialDefinition& material, Value&& value) {
  if (const auto* soil = std::get_if<DruckerPragerDefinition>(&material.law)) return value(*soil);
  if (const auto* soil = std::get_if<MohrCoulombDefinition>(&material.law)) return value(*soil);
  throw MaterialError(refused_implicit(material));
}

template <class Soil>
void take_surface(const Soil& d, ImplicitSoil& soil) {
  const Soil last = d.softening.falls() ? weakened(d, 0.0) : d;
  soil.sine = {std::sin(d.friction_angle), std::sin(last.friction_angle)};
  soil.cohesion = {d.cohesion * std::cos(d.friction_angle), last.cohesion * std::cos(last.friction_angle)};
  soil.dilation = std::sin(d.dilation_angle);
  soil.follows_lode = true;
}

void take_cone(const DruckerPragerDefinition& d, ImplicitSoil& soil) {
  const DruckerPrager cone(d, soil.density), last(d.softening.falls() ? weakened(d, 0.0) : d, soil.density);
  soil.sine = {cone.eta(), last.eta()};
  soil.cohesion = {cone.strength(), last.strength()};
  soil.dilation = cone.eta_bar();
  soil.follows_lode = false;
}

}  // namespace

std::string refused_implicit(const MaterialDefinition& material) {
  if (std::holds_alternative<DruckerPragerDefinition>(material.law)) return {};
  if (std::holds_alternative<MohrCoulombDefinition>(material.law)) return {};
  return fmt::format(
      "implicit steps are made for soil of drucker_prager and mohr_coulomb, not for '{}' ({}); use usavg",
      material.name, law_name(material.law));
}

ImplicitSoil::ImplicitSoil(const MaterialDefinition& material)
    : density(material.density),
      dilation_end(of_soil(material, [](const auto& d) { return d.softening.dilation_limit(d.dilation_limit); })),
      fall(of_soil(material, [](const auto& d) { return d.softening; })) {
  of_soil(material, [&](const auto& d) {
    least = d.tension_cutoff < 0.0 ? -kNoLimit : -std::sqrt(3.0) * d.tension_cutoff;
    bulk = d.elasticity.bulk();
    shear = d.elasticity.shear();
    return 0;
  });
  const auto* round = std::get_if<DruckerPragerDefinition>(&material.law);
  if (round != nullptr && round->match != ConeMatch::mohr_coulomb) {
    take_cone(*round, *this);
  } else {
    of_soil(material, [&](const auto& d) {
      take_surface(d, *this);
      return 0;
    });
  }
}

}  // namespace mpm
