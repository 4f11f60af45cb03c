#include "mpm/material/mu_i.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/math/constants.hpp"

namespace mpm {
namespace {

/// Largest flow_stiffness() of all stresses at the friction `mu`: in principal axes flow is s / (2 sqrt(J2)), and the
/// normal of the surface that plus mu / 3. Lode angles are sampled, triaxial compression and extension among them.
double round_cone_stiffness(double bulk, double shear, double mu) {
  constexpr int kAngles = 60;
  const double third = 2.0 / 3.0 * kPi, scale = 2.0 / std::sqrt(3.0);
  double most = 0.0;
  for (int k = 0; k <= kAngles; ++k) {
    const double angle = 0.5 * third * k / kAngles;
    PrincipalValues flow, normal;
    for (int i = 0; i < 3; ++i) {
      flow[i] = shear * scale * std::cos(angle - i * third);
      normal[i] = flow[i] + bulk * mu;
    }
    most = std::max(most, flow_stiffness(flow, normal, shear));
  }
  return most;
}

}  // namespace

MuI::MuI(const MuIDefinition& d, double density)
    : density_(density),
      bulk_(d.elasticity.bulk()),
      shear_(d.elasticity.shear()),
      static_friction_(d.static_friction),
      friction_rise_(d.limiting_friction - d.static_friction),
      reference_(d.reference_inertial / (d.grain_diameter * std::sqrt(d.grain_density))),
      flow_(std::max(round_cone_stiffness(bulk_, shear_, d.static_friction),
                     round_cone_stiffness(bulk_, shear_, d.limiting_friction))) {}

}  // namespace mpm
