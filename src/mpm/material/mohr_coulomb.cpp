#include "mpm/material/mohr_coulomb.hpp"

#include <limits>

namespace mpm {

MohrCoulomb::MohrCoulomb(const MohrCoulombDefinition& d, double density)
    : density_(density),
      bulk_(d.elasticity.bulk()),
      shear_(d.elasticity.shear()),
      sin_friction_(std::sin(d.friction_angle)),
      sin_dilation_(std::sin(d.dilation_angle)),
      strength_(2.0 * d.cohesion * std::cos(d.friction_angle)) {
  const double apex =
      sin_friction_ > 0.0 ? d.cohesion / std::tan(d.friction_angle) : std::numeric_limits<double>::infinity();
  cutoff_is_apex_ = d.tension_cutoff < 0.0 || d.tension_cutoff >= apex;
  cutoff_ = cutoff_is_apex_ ? apex : d.tension_cutoff;
  open_flow_ = flow_stiffness(0.0);
  closed_flow_ = flow_stiffness(sin_dilation_);
}

}  // namespace mpm
