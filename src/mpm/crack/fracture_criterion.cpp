#include "mpm/crack/fracture_criterion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

/// Density of strain energy at angle -`angle` sign(K_II), times 16 pi G r, for K_I and |K_II|.
double energy_density(double angle, double one, double two, double kappa) {
  const double c = std::cos(angle), s = std::sin(angle);
  return (1.0 + c) * (kappa - c) * one * one - 2.0 * s * (2.0 * c - kappa + 1.0) * one * two +
         ((kappa + 1.0) * (1.0 - c) + (1.0 + c) * (3.0 * c - 1.0)) * two * two;
}

double energy_density_slope(double angle, double one, double two, double kappa) {
  const double c = std::cos(angle), s = std::sin(angle);
  return s * (2.0 * c - kappa + 1.0) * one * one - 2.0 * (c * (2.0 * c - kappa + 1.0) - 2.0 * s * s) * one * two +
         s * (kappa - 1.0 - 6.0 * c) * two * two;
}

std::string constant_missing(FractureCriterion criterion, const char* constant, const char* meaning) {
  return fmt::format("criterion '{}' needs {}, {}: give it to the material, or choose another criterion",
                     kFractureCriterionNames[static_cast<int>(criterion)], constant, meaning);
}

std::string steady_state_fault(const FractureConstants& constants) {
  if (!(constants.speed > 0.0)) {
    return constant_missing(FractureCriterion::steady_state, "speed", "at which the crack grows [m/s], above 0");
  }
  if (constants.start_time < 0.0 && !(constants.j_ic > 0.0)) {
    return constant_missing(FractureCriterion::steady_state, "j_ic [J/m^2] or start_time [s]",
                            "at which growth starts");
  }
  return {};
}

std::string energy_balance_fault(const FractureConstants& constants, const ElasticConstants* elastic) {
  const FractureCriterion criterion = FractureCriterion::energy_balance;
  if (!(constants.j_ic > 0.0)) return constant_missing(criterion, "j_ic", "the J at which growth starts [J/m^2]");
  if (!(constants.speed > 0.0 && constants.speed <= 1.0)) {
    return constant_missing(criterion, "speed", "at the start as part of the wave speed, above 0 and at most 1");
  }
  if (!(constants.gain > 0.0)) return constant_missing(criterion, "gain", "of its speed [(m/s)/(J/m^2)], above 0");
  if (elastic == nullptr || !(elastic->density > 0.0)) {
    return "criterion 'energy_balance' needs the wave speed of an isotropic elastic material with a density: choose "
           "'steady_state' with a speed, or 'release_rate'";
  }
  return {};
}

std::string energy_density_fault(const ElasticConstants& elastic) {
  const double kappa = elastic.kappa();
  if (kappa > 1.0 && kappa < 3.0) return {};
  return fmt::format(
      "criterion 'energy_density' needs a Poisson's ratio above 0 and, in plane strain, below 0.5; the material's is "
      "{:g}: choose 'hoop_stress'",
      elastic.poisson);
}

}  // namespace

double hoop_angle(double one, double two) {
  // tan(angle / 2) = (K_I - sqrt(K_I^2 + 8 K_II^2)) / (4 K_II), in the form without cancellation for each sign.
  const double shear = std::abs(two), root = std::hypot(one, std::sqrt(8.0) * two);
  if (shear == 0.0) return 0.0;
  const double half = one >= 0.0 ? std::atan2(2.0 * shear, one + root) : std::atan2(root - one, 4.0 * shear);
  return two > 0.0 ? -2.0 * half : 2.0 * half;
}

double hoop_equivalent(const StressIntensity& k) {
  const double angle = hoop_angle(k.one, k.two), c = std::cos(0.5 * angle);
  return k.one * c * c * c - 1.5 * k.two * c * std::sin(angle);
}

double density_angle(double one, double two, double kappa) {
  one = std::max(one, 0.0);
  const double shear = std::abs(two);
  if (shear == 0.0) return 0.0;
  // In pure shear the minimum lies at `end`, with K_I closer; the slope there may have changed sign twice.
  const double end = std::acos(std::clamp((kappa - 1.0) / 6.0, -1.0, 1.0));
  constexpr int kSteps = 256;
  double angle = end;
  for (int i = 1; i <= kSteps; ++i) {
    if (!(energy_density_slope(end * i / kSteps, one, shear, kappa) > 0.0)) continue;
    double low = end * (i - 1) / kSteps, high = end * i / kSteps;
    for (int n = 0; n < 50; ++n) {
      const double middle = 0.5 * (low + high);
      (energy_density_slope(middle, one, shear, kappa) > 0.0 ? high : low) = middle;
    }
    angle = 0.5 * (low + high);
    break;
  }
  return two > 0.0 ? -angle : angle;
}

double density_equivalent(const StressIntensity& k, double kappa) {
  const double one = std::max(k.one, 0.0), shear = std::abs(k.two);
  const double angle = std::abs(density_angle(one, shear, kappa));
  return std::sqrt(energy_density(angle, one, shear, kappa) / (2.0 * (kappa - 1.0)));
}

double elliptical_measure(const StressIntensity& k, const FractureConstants& constants) {
  return std::pow(std::max(k.one, 0.0) / constants.k_ic, constants.k_exponent) +
         std::pow(std::abs(k.two) / constants.k_iic, constants.k_ii_exponent);
}

bool needs_stress_intensity(FractureCriterion criterion) {
  return criterion == FractureCriterion::hoop_stress || criterion == FractureCriterion::energy_density ||
         criterion == FractureCriterion::elliptical;
}

std::string criterion_fault(const GrowthRule& rule, const FractureConstants& constants, const ElasticConstants* elastic,
                            bool alternate) {
  const FractureCriterion criterion = rule.criterion;
  const std::string name = kFractureCriterionNames[static_cast<int>(criterion)];
  const bool paced = criterion == FractureCriterion::steady_state || criterion == FractureCriterion::energy_balance;
  if (alternate && paced) {
    return fmt::format("criterion '{}' sets the tip's speed and cannot be the alternate one: make it the first", name);
  }
  if (needs_stress_intensity(criterion)) {
    if (elastic == nullptr) {
      return fmt::format(
          "criterion '{}' needs stress intensities, which only isotropic elastic materials have: choose "
          "'release_rate' or 'opening'",
          name);
    }
    if (!(constants.k_ic > 0.0)) return constant_missing(criterion, "k_ic", "the toughness in mode I [Pa sqrt(m)]");
  }
  switch (criterion) {
    case FractureCriterion::none:
    case FractureCriterion::hoop_stress:
      return {};
    case FractureCriterion::steady_state:
      return steady_state_fault(constants);
    case FractureCriterion::energy_balance:
      return energy_balance_fault(constants, elastic);
    case FractureCriterion::energy_density:
      return energy_density_fault(*elastic);
    case FractureCriterion::elliptical:
      if (!(constants.k_iic > 0.0))
        return constant_missing(criterion, "k_iic", "the toughness in mode II [Pa sqrt(m)]");
      if (constants.k_exponent > 0.0 && constants.k_ii_exponent > 0.0) return {};
      return constant_missing(criterion, "k_exponent and k_ii_exponent", "the powers of its ellipse, above 0");
    case FractureCriterion::opening:
      if (constants.opening_ic > 0.0 || constants.opening_iic > 0.0) return {};
      return constant_missing(criterion, "opening_ic or opening_iic",
                              "the largest opening across or along the faces [m]");
    case FractureCriterion::release_rate:
      return constants.j_ic > 0.0 ? std::string() : constant_missing(criterion, "j_ic", "the largest J [J/m^2]");
  }
  return {};
}

}  // namespace mpm
