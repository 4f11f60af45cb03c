#include "mpm/crack/stress_intensity.hpp"

#include <cmath>

namespace mpm {

StressIntensity split_by_openings(double j, double normal_opening, double shear_opening,
                                  const ElasticConstants& constants, double speed) {
  const double size = std::hypot(normal_opening, shear_opening);
  const RunningTip tip = running_tip(constants, speed);
  if (!(j > 0.0) || !(size > 0.0) || !tip.possible) return {};
  const double normal = normal_opening / size, shear = shear_opening / size;
  // In a running tip's field the openings are to K_I and K_II as A_I / beta_s and A_II / beta_d, which are equal.
  const double q = normal * normal * tip.beta_s + shear * shear * tip.beta_d;
  const double energy = 2.0 * constants.shear_modulus() * j / q;
  return {normal * std::sqrt(energy * tip.beta_s / tip.one), shear * std::sqrt(energy * tip.beta_d / tip.two)};
}

double release_rate(const StressIntensity& k, const ElasticConstants& constants, double speed) {
  const RunningTip tip = running_tip(constants, speed);
  if (!tip.possible) return 0.0;
  return (tip.one * k.one * k.one + tip.two * k.two * k.two) / (2.0 * constants.shear_modulus());
}

}  // namespace mpm
