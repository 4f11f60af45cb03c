#include "mpm/implicit/soil_law.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "mpm/material/law.hpp"

namespace mpm {
namespace {

constexpr double kNoLimit = 1e30;  ///< limit of tension [Pa]

/// One of the laws that implicit steps have, as ImplicitSoil sees it.
class Reader {
 public:
  Reader(ImplicitSoil& soil, Fall& cohesion, std::optional<J2PlasticityDefinition>& metal)
      : soil_(soil), cohesion_(cohesion), metal_(metal) {}

  bool operator()(const DruckerPragerDefinition& d) {
    take_soil<DruckerPrager>(d);
    if (d.match == ConeMatch::mohr_coulomb) return true;
    const DruckerPrager cone(d, soil_.density), last(d.softening.falls() ? weakened(d, 0.0) : d, soil_.density);
    soil_.sine = {cone.eta(), last.eta()};
    cohesion_ = {cone.strength(), last.strength()};
    soil_.dilation = cone.eta_bar();
    soil_.follows_lode = false;
    return true;
  }
  bool operator()(const MohrCoulombDefinition& d) {
    take_soil<MohrCoulomb>(d);
    return true;
  }
  bool operator()(const MuIDefinition& d) {
    take_elasticity(d.elasticity);
    take_history<MuI>();
    soil_.opening_at = MuI::kOpening;
    soil_.sine = {d.static_friction, d.static_friction};
    soil_.friction_rise = d.limiting_friction - d.static_friction;
    soil_.reference_rate = d.reference_inertial / (d.grain_diameter * std::sqrt(d.grain_density));
    return true;
  }
  bool operator()(const J2PlasticityDefinition& d) {
    take_elasticity(d.elasticity);
    take_history<J2Plasticity>();
    metal_ = d;
    soil_.yield_stress = d.saturation_rate > 0.0 ? d.saturation_stress : d.yield_stress;
    soil_.least = -kNoLimit;
    soil_.per_strain = -1.0;
    soil_.strain_of_shear = std::sqrt(2.0 / 3.0);
    return true;
  }
  template <class Other>
  bool operator()(const Other&) {
    return false;
  }

 private:
  void take_elasticity(const Elasticity& elasticity) {
    soil_.bulk = elasticity.bulk();
    soil_.shear = elasticity.shear();
  }
  template <class Law>
  void take_history() {
    soil_.strain_at = Law::kPlasticStrain;
    soil_.work_at = Law::kPlasticWork;
    soil_.strain_of_shear = std::sqrt(2.0);  // sqrt(2 de:de)
  }
  template <class Law, class Definition>
  void take_soil(const Definition& d) {
    take_elasticity(d.elasticity);
    take_history<Law>();
    soil_.opening_at = Law::kOpening;
    const Definition last = d.softening.falls() ? weakened(d, 0.0) : d;
    soil_.sine = {std::sin(d.friction_angle), std::sin(last.friction_angle)};
    cohesion_ = {d.cohesion * std::cos(d.friction_angle), last.cohesion * std::cos(last.friction_angle)};
    soil_.dilation = std::sin(d.dilation_angle);
    soil_.follows_lode = true;
    soil_.least = d.tension_cutoff < 0.0 ? -kNoLimit : -std::sqrt(3.0) * d.tension_cutoff;
    const DilationEnd end(d.softening.dilation_limit(d.dilation_limit));
    soil_.dilation_start = end.start();
    soil_.dilation_slope = end.slope();
    soil_.per_strain = StrengthFall(d.softening).per_strain();
  }

  ImplicitSoil& soil_;
  Fall& cohesion_;
  std::optional<J2PlasticityDefinition>& metal_;
};

}  // namespace

std::string refused_implicit(const MaterialDefinition& material) {
  if (traits_of(material).implicit != ImplicitSteps::refused) return {};
  return fmt::format("implicit steps are made for {}, not for '{}' ({}); use usavg",
                     law_names([](const LawTraits& traits) { return traits.implicit != ImplicitSteps::refused; }),
                     material.name, law_name(material.law));
}

ImplicitSoil::ImplicitSoil(const MaterialDefinition& material) : density(material.density) {
  if (!std::visit(Reader(*this, cohesion_, metal_), material.law)) throw MaterialError(refused_implicit(material));
}

mpm_kernel::SoilConstants ImplicitSoil::constants() const {
  mpm_kernel::SoilConstants of{};
  of.bulk = bulk;
  of.shear = shear;
  of.sine_end = sine.residual;
  of.sine_fall = sine.peak - sine.residual;
  of.cohesion_end = cohesion_.residual;
  of.cohesion_fall = cohesion_.peak - cohesion_.residual;
  of.dilation = dilation;
  of.least = least;
  of.friction_rise = friction_rise;
  of.reference_rate = reference_rate;
  of.follows_lode = follows_lode;
  of.opens = opening_at.has_value();
  of.metal = metal_.has_value();
  if (!metal_) return of;
  of.yield = metal_->yield_stress;
  of.hardening = metal_->hardening_modulus;
  of.saturation = metal_->saturation_rate > 0.0 ? metal_->saturation_stress - metal_->yield_stress : 0.0;
  of.saturation_rate = metal_->saturation_rate;
  return of;
}

SoilRange::SoilRange(const std::vector<ImplicitSoil>& soils) : least_density(soils.front().density) {
  for (const ImplicitSoil& soil : soils) {
    least_density = std::min(least_density, soil.density);
    double& largest = soil.yield_stress > 0.0 ? metal_modulus : modulus;
    largest = std::max(largest, soil.bulk + 4.0 / 3.0 * soil.shear);
    yield_stress = std::max(yield_stress, soil.yield_stress);
  }
  if (modulus == 0.0) modulus = metal_modulus;
}

}  // namespace mpm
