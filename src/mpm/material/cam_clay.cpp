#include "mpm/material/cam_clay.hpp"

namespace mpm {

CamClay::CamClay(const CamClayDefinition& d, double density)
    : density_(density),
      volume_(1.0 + d.void_ratio),
      kappa_(d.kappa),
      hardening_(d.kappa / (d.lambda - d.kappa)),
      slope_(d.slope),
      shear_(d.shear_modulus),
      shear_of_bulk_(d.shear_modulus > 0.0 ? 0.0 : d.shear_over_bulk()),
      consolidation_(d.consolidation > 0.0 ? d.consolidation : d.overconsolidation * d.least_pressure),
      least_(d.least_pressure),
      ratio_(d.overconsolidation) {}

Symmetric3<double> CamClay::elastic_strain(const StressedPoint& at) const {
  const Symmetric3<double>& cauchy = at.cauchy;
  const double mean = trace(cauchy) / 3.0, pressure = std::max(-mean, 0.0);
  const double volume = -kappa_ / (volume_ * at.j) * std::log1p(pressure / least_);
  const double shear = shear_at(pressure, at.j);
  return scale_shift(cauchy, 0.5 / shear, volume / 3.0 - 0.5 * mean / shear);
}

double CamClay::initial_hardening(const Symmetric3<double>& cauchy) const {
  if (ratio_ == 0.0) return 0.0;
  const double pressure = -trace(cauchy) / 3.0;
  if (!(pressure > 0.0)) return 0.0;
  const double j2 = 0.5 * squared_norm(scale_shift(cauchy, 1.0, pressure));
  const double through = pressure + 3.0 * j2 / (slope_ * slope_ * pressure);
  return std::max(std::log(ratio_ * through / consolidation_), 0.0);
}

}  // namespace mpm
