#include "mpm/crack/elastic_constants.hpp"

#include <cmath>

#include "mpm/material/law.hpp"
#include "mpm/math/constants.hpp"

namespace mpm {
namespace {

/// c_s^2 / c_d^2 in the plane.
double squared_ratio_of_waves(double kappa) { return (kappa - 1.0) / (kappa + 1.0); }

/// Rayleigh's function D = 4 beta_d beta_s - (1 + beta_s^2)^2 over b = c^2 / c_s^2, with `ratio` = c_s^2 / c_d^2. From
/// beta_d beta_s = 1 - s / (1 + beta_d beta_s), s = b (1 + ratio - ratio b), so that b divides out.
double rayleigh_function(double b, double ratio) {
  const double product = std::sqrt((1.0 - ratio * b) * (1.0 - b));
  return 4.0 - b - 4.0 * (1.0 + ratio - ratio * b) / (1.0 + product);
}

}  // namespace

std::optional<ElasticConstants> elastic_constants_of(const MaterialDefinition& material, GeometryKind geometry) {
  const LawTraits traits = traits_of(material);
  const std::optional<Elasticity> elasticity = elasticity_of(material.law);
  if (!elasticity || traits.matter != Matter::solid || traits.rate_dependent) return std::nullopt;
  return ElasticConstants::of(elasticity->young, elasticity->poisson, material.density, geometry);
}

double ElasticConstants::dilatational_speed() const {
  return density > 0.0 ? shear_speed() / std::sqrt(squared_ratio_of_waves(kappa())) : kInfinity;
}

double ElasticConstants::shear_speed() const {
  return density > 0.0 ? std::sqrt(shear_modulus() / density) : kInfinity;
}

double ElasticConstants::rayleigh_speed() const {
  if (!(density > 0.0)) return kInfinity;
  // The function falls from 2 (1 - ratio) at 0 to a negative value at 1, and is zero once.
  const double ratio = squared_ratio_of_waves(kappa());
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (rayleigh_function(middle, ratio) > 0.0 ? low : high) = middle;
  }
  return shear_speed() * std::sqrt(low);
}

RunningTip running_tip(const ElasticConstants& constants, double speed) {
  RunningTip tip;
  const double ratio = squared_ratio_of_waves(constants.kappa());
  const double b = speed * speed * constants.density / constants.shear_modulus();
  const double d = b < 1.0 ? rayleigh_function(b, ratio) : 0.0;
  tip.possible = d > 0.0;
  if (!tip.possible) return tip;
  tip.beta_d = std::sqrt(1.0 - ratio * b);
  tip.beta_s = std::sqrt(1.0 - b);
  tip.one = tip.beta_d / d;
  tip.two = tip.beta_s / d;
  return tip;
}

}  // namespace mpm
