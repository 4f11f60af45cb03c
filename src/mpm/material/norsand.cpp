#include "mpm/material/norsand.hpp"

#include "mpm/material/norsand_energy.hpp"
#include "mpm/material/opening.hpp"
#include "mpm/math/constants.hpp"

namespace mpm {
namespace {

constexpr double kReference = 1e5;  ///< [Pa]
constexpr double kMostRatio = 2.2;  ///< q / p of the densest sand: a friction angle of 54 degrees
constexpr double kLoosest = 0.6;    ///< largest chi_i psi over M: looser sand would not harden under pressure alone
constexpr double kInside = 1e-12;   ///< by which the initial stress is kept inside the surface

}  // namespace

NorSand::NorSand(const NorSandDefinition& d, double density)
    : density_(density),
      void_ratio_(d.void_ratio),
      gamma_(d.gamma),
      lambda_(d.lambda),
      curve_(d.critical_exponent),
      slope_(d.slope),
      coupling_(d.coupling),
      chi_(d.image_dilatancy()),
      densest_(std::max(kMostRatio - d.slope, 0.0) / (1.0 - d.coupling)),
      loosest_(kLoosest * d.slope),
      hardening_(d.hardening),
      hardening_of_state_(d.hardening_of_state),
      exponent_(d.shear_exponent),
      stiffness_(d.shear_modulus / (d.shear_over_bulk() * std::pow(kReference, d.shear_exponent))),
      shear_over_bulk_(d.shear_over_bulk()),
      least_(d.least_pressure),
      least_root_(power(d.least_pressure, 1.0 - d.shear_exponent)),
      spring_((1.0 - d.shear_exponent) * stiffness_),
      least_lode_(3.0 / (3.0 + d.slope)),
      lode_mean_(0.5 * std::pow(least_lode_, -4.0) + 0.5),
      lode_half_(0.5 * std::pow(least_lode_, -4.0) - 0.5),
      ratio_(d.overconsolidation),
      flow_(largest_flow_stiffness()) {}

Symmetric3<double> NorSand::elastic_strain(const StressedPoint& at) const {
  const Symmetric3<double>& cauchy = at.cauchy;
  const double mean = trace(cauchy) / 3.0, raised = std::max(-mean, 0.0) + least_;
  const double volume = (least_root_ - power(raised, 1.0 - exponent_)) / spring_;
  const double shear = shear_over_bulk_ * bulk_at(raised);
  return scale_shift(cauchy, 0.5 / shear, volume / 3.0 - 0.5 * mean / shear);
}

// M_i depends on the image pressure by psi, little: a fixed point, whose steps fall by N chi lambda / M.
double NorSand::initial_hardening(const Symmetric3<double>& cauchy) const {
  const double pressure = -trace(cauchy) / 3.0;
  if (!(pressure > 0.0)) return 0.0;
  const Symmetric3<double> deviator = scale_shift(cauchy, 1.0, pressure);
  const double j2 = 0.5 * squared_norm(deviator);
  const double q_over_p = std::sqrt(3.0 * j2) / (lode_factor(deviator, j2) * pressure);
  constexpr int kSteps = 60;
  double image = pressure + least_;
  for (int i = 0; i < kSteps; ++i) {
    image = (pressure + least_) * std::exp(q_over_p / surface(void_ratio_, image).slope - 1.0);
  }
  return std::log(ratio_ * image / least_) + kInside;
}

// Largest flow_stiffness() of all stresses, for K = 1. In principal axes the flow is m = 3 s / 2 q - D / 3. The surface
// is B = p y(p) with B = q M / M(theta); its slope over p is y - M_i, or y at the cap. Stress ratios, states and Lode
// angles are sampled, with triaxial compression and extension among them. A rise or fall of p_i by flow adds little to
// h, p beside G; a tenth is left for the fall.
double NorSand::largest_flow_stiffness() const {
  constexpr int kAngles = 12, kStates = 2, kRatios = 4;
  constexpr double kFall = 1.1;
  const double third = 2.0 / 3.0 * kPi, shear = shear_over_bulk_;
  double most = 0.0;
  for (int a = 0; a <= kAngles; ++a) {
    const double angle = 0.5 * third * a / kAngles;
    PrincipalValues s;  // over q
    for (int i = 0; i < 3; ++i) s[i] = 2.0 / 3.0 * std::cos(angle - i * third);
    const double product = s[0] * s[1] * s[2], squared = lode_mean_ + 13.5 * lode_half_ * product;
    const double lode = 1.0 / std::sqrt(std::sqrt(squared));
    PrincipalValues normal;  // derivative of B over s: 1 / lode = squared^(1/4)
    for (int i = 0; i < 3; ++i) {
      const double other = s[(i + 1) % 3] * s[(i + 2) % 3] + 1.0 / 9.0;  // its mean is -1/9
      normal[i] = 1.5 * s[i] / lode + 0.25 * 13.5 * lode_half_ * std::pow(lode, 3.0) * (other - 4.5 * product * s[i]);
    }
    for (int state = 0; state <= kStates; ++state) {
      const double dilation = densest_ * state / kStates, slope = slope_ - coupling_ * dilation;
      for (int r = 0; r <= kRatios + 1; ++r) {
        const bool cap = r > kRatios;
        const double y = (slope + dilation) * (cap ? 1.0 : static_cast<double>(r) / kRatios);
        const double loss = lode * (slope - y), along = cap ? y : y - slope;
        PrincipalValues p, q;
        for (int i = 0; i < 3; ++i) {
          p[i] = 3.0 * shear * s[i] - loss;
          q[i] = 2.0 * shear * normal[i] + along;
        }
        most = std::max(most, flow_stiffness(p, q, 3.0 * shear / lode - along * loss));
      }
    }
  }
  return kFall * most;
}

}  // namespace mpm
