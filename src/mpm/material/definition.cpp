#include "mpm/material/definition.hpp"

#include <fmt/core.h>

#include <cmath>

namespace mpm {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;

/// Throws unless `holds`; false for NaN, so that every condition is written as what must be true.
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

/// Angles and strengths of either law of soil; `apex` is what the text calls it.
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
  require(std::isfinite(law.tension_cutoff), material,
          fmt::format("tension cut-off is {:g} Pa; it must be finite (negative: {})", law.tension_cutoff, apex));
  // c cot(phi), for every match of the cone too (method reference 10.6: xi / eta); there is none without friction.
  if (friction > 0.0) {
    const double largest = law.cohesion / std::tan(friction);
    require(law.tension_cutoff <= largest * (1.0 + 1e-12), material,  // an apex given as the cut-off may be rounded
            fmt::format("tension cut-off is {:g} Pa; it must not lie above {}, cohesion / tan(friction angle) = "
                        "{:g} Pa",
                        law.tension_cutoff, apex, largest));
  }
}

struct Checker {
  const MaterialDefinition& material;

  void operator()(const LinearElasticDefinition& law) const { check(material, law.elasticity); }
  void operator()(const NeoHookeanDefinition& law) const { check(material, law.elasticity); }
  void operator()(const DruckerPragerDefinition& law) const { check_soil(material, law, "the cone's apex"); }
  void operator()(const MohrCoulombDefinition& law) const { check_soil(material, law, "the apex"); }
};

struct Name {
  std::string operator()(const LinearElasticDefinition&) const { return "linear_elastic"; }
  std::string operator()(const NeoHookeanDefinition&) const { return "neo_hookean"; }
  std::string operator()(const DruckerPragerDefinition&) const { return "drucker_prager"; }
  std::string operator()(const MohrCoulombDefinition&) const { return "mohr_coulomb"; }
};

}  // namespace

void check(const MaterialDefinition& material) {
  if (material.name.empty()) throw MaterialError("material without a name; give it one");
  require(material.density > 0.0 && std::isfinite(material.density), material,
          fmt::format("density is {:g} kg/m^3; it must be positive and finite", material.density));
  std::visit(Checker{material}, material.law);
}

std::string law_name(const LawDefinition& law) { return std::visit(Name{}, law); }

}  // namespace mpm
