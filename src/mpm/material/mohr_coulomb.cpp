#include "mpm/material/mohr_coulomb.hpp"

#include <limits>

namespace mpm {

MohrCoulomb::MohrCoulomb(const MohrCoulombDefinition& d, double density)
    : density_(density),
      bulk_(d.elasticity.bulk()),
      shear_(d.elasticity.shear()),
      sin_friction_(std::sin(d.friction_angle)),
      sin_dilation_(std::sin(d.dilation_angle)),
      strength_(2.0 * d.cohesion * std::cos(d.friction_angle)),
      dilation_end_(d.softening.dilation_limit(d.dilation_limit)),
      fall_(d.softening) {
  const double apex =
      sin_friction_ > 0.0 ? d.cohesion / std::tan(d.friction_angle) : std::numeric_limits<double>::infinity();
  cutoff_is_apex_ = d.tension_cutoff < 0.0 || d.tension_cutoff >= apex;
  cutoff_ = cutoff_is_apex_ ? apex : d.tension_cutoff;
  // Soil that has opened, or dilated to its limit, flows without dilation.
  flow_ = std::max(largest_flow_stiffness(0.0), largest_flow_stiffness(sin_dilation_));
  // With use_room() volume is free: shear has 4/3 G and (|p - q|/2)^2 / h is at most 3/4 G, more than elastic if K <
  // 3/4 G.
  if (!cutoff_is_apex_) flow_ = std::max(flow_, 0.75 * shear_ - bulk_);
  if (!fall_.falls()) return;
  const double residual = d.softening.friction_angle;
  sine_fall_ = {sin_friction_, std::sin(residual)};
  strength_fall_ = {strength_, 2.0 * d.softening.cohesion * std::cos(residual)};
  for (const double left : kPartsOfAFall) {
    const MohrCoulombDefinition soil = weakened(d, left);
    const MohrCoulomb law(soil, density);
    flow_ = std::max({flow_, law.largest_flow_stiffness(0.0), law.largest_flow_stiffness(law.sin_dilation_)});
  }
}

/// Largest flow_stiffness() of the main plane, and of both planes of an edge, as their sum and their difference; q:
/// sine of the dilation angle.
double MohrCoulomb::largest_flow_stiffness(double q) const {
  const double s = sin_friction_;
  const auto stress = [this](const PrincipalValues& m) {
    const double volumetric = lame() * (m[0] + m[1] + m[2]);
    return PrincipalValues{volumetric + 2.0 * shear_ * m[0], volumetric + 2.0 * shear_ * m[1],
                           volumetric + 2.0 * shear_ * m[2]};
  };
  const auto of_planes = [&](const PrincipalValues& flow, const PrincipalValues& normal) {
    const PrincipalValues p = stress(flow), n = stress(normal);
    const double h = p[0] * normal[0] + p[1] * normal[1] + p[2] * normal[2];
    return flow_stiffness(p, n, h);
  };
  double most = of_planes({1.0 + q, 0.0, -1.0 + q}, {1.0 + s, 0.0, -1.0 + s});
  most = std::max(most, of_planes({2.0 + 2.0 * q, -1.0 + q, -1.0 + q}, {2.0 + 2.0 * s, -1.0 + s, -1.0 + s}) +
                            of_planes({0.0, 1.0 - q, -1.0 + q}, {0.0, 1.0 - s, -1.0 + s}));
  return std::max(most, of_planes({1.0 + q, 1.0 + q, -2.0 + 2.0 * q}, {1.0 + s, 1.0 + s, -2.0 + 2.0 * s}) +
                            of_planes({1.0 + q, -1.0 - q, 0.0}, {1.0 + s, -1.0 - s, 0.0}));
}

}  // namespace mpm
