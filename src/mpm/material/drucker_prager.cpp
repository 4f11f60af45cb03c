#include "mpm/material/drucker_prager.hpp"

#include <limits>

namespace mpm {
namespace {

// Slope of the cone that passes through the Mohr-Coulomb state `match`, method reference 10.6.
double slope(double angle, ConeMatch match) {
  const double s = std::sin(angle);
  switch (match) {
    case ConeMatch::compression:
      return 6.0 * s / (std::sqrt(3.0) * (3.0 - s));
    case ConeMatch::extension:
      return 6.0 * s / (std::sqrt(3.0) * (3.0 + s));
    case ConeMatch::plane_strain:
      break;
  }
  const double t = std::tan(angle);
  return 3.0 * t / std::sqrt(9.0 + 12.0 * t * t);
}

double cohesion_factor(double angle, ConeMatch match) {
  const double s = std::sin(angle), c = std::cos(angle);
  switch (match) {
    case ConeMatch::compression:
      return 6.0 * c / (std::sqrt(3.0) * (3.0 - s));
    case ConeMatch::extension:
      return 6.0 * c / (std::sqrt(3.0) * (3.0 + s));
    case ConeMatch::plane_strain:
      break;
  }
  const double t = std::tan(angle);
  return 3.0 / std::sqrt(9.0 + 12.0 * t * t);
}

}  // namespace

DruckerPrager::DruckerPrager(const DruckerPragerDefinition& d, double density)
    : density_(density), bulk_(d.elasticity.bulk()), shear_(d.elasticity.shear()) {
  eta_ = slope(d.friction_angle, d.match);
  eta_bar_ = slope(d.dilation_angle, d.match);
  strength_ = cohesion_factor(d.friction_angle, d.match) * d.cohesion;
  apex_ = eta_ > 0.0 ? strength_ / eta_ : std::numeric_limits<double>::infinity();
  cutoff_ = d.tension_cutoff < 0.0 ? apex_ : std::min(d.tension_cutoff, apex_);
}

}  // namespace mpm
