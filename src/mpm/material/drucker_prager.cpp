#include "mpm/material/drucker_prager.hpp"

#include <limits>

#include "mpm/math/constants.hpp"

namespace mpm {
namespace {

/// A round cone: slope eta, xi = factor of cohesion, and dilation eta_bar.
struct Cone {
  double eta, xi, eta_bar;
};

/// Largest k (drucker_prager.hpp) of all Lode angles. k = cos(a) + cos(60 - a) + (cos(a) - cos(60 - a)) sine over
/// sqrt(3) has this amplitude, and reaches it between compression and extension for every sine.
double most_shear(double sine) { return std::sqrt(1.0 + sine * sine / 3.0); }

/// k at the Lode angle of a match.
double shear_at(ConeMatch match, double sine) {
  const double root = std::sqrt(3.0);
  return match == ConeMatch::compression ? (3.0 - sine) / (2.0 * root) : (3.0 + sine) / (2.0 * root);
}

/// The cone through Mohr-Coulomb in plane strain, for any dilation. Without plastic strain along y, s_y = -2/3 eta_bar
/// sqrt(J2), so that half the difference of the principal stresses in the plane is t = A sqrt(J2), A = sqrt(1 -
/// eta_bar^2/3), and their mean is m = p + eta_bar sqrt(J2)/3. Flow dilates by sin(psi) = eta_bar / A. On the cone,
/// t (1 - eta eta_bar/3) = A (xi c - eta m), and Mohr-Coulomb is t = c cos(phi) - m sin(phi); exact-solutions 31.
Cone plane_strain_cone(double friction, double dilation) {
  const double s = std::sin(friction), q = std::sin(dilation);
  const double root = std::sqrt(9.0 + 3.0 * q * q), over = root / (3.0 + s * q);
  return {s * over, std::cos(friction) * over, 3.0 * q / root};
}

Cone cone(const DruckerPragerDefinition& d) {
  const double s = std::sin(d.friction_angle), q = std::sin(d.dilation_angle), c = std::cos(d.friction_angle);
  switch (d.match) {
    case ConeMatch::plane_strain:
      return plane_strain_cone(d.friction_angle, d.dilation_angle);
    case ConeMatch::mohr_coulomb: {
      const double shear = most_shear(s);
      return {s / shear, c / shear, q / most_shear(q)};
    }
    case ConeMatch::compression:
    case ConeMatch::extension:
      break;
  }
  const double shear = shear_at(d.match, s);
  return {s / shear, c / shear, q / shear_at(d.match, q)};
}

}  // namespace

DruckerPrager::DruckerPrager(const DruckerPragerDefinition& d, double density)
    : density_(density),
      bulk_(d.elasticity.bulk()),
      shear_(d.elasticity.shear()),
      follows_lode_(d.match == ConeMatch::mohr_coulomb),
      sin_friction_(std::sin(d.friction_angle)),
      sin_dilation_(std::sin(d.dilation_angle)),
      most_shear_(most_shear(sin_friction_)),
      most_dilation_shear_(most_shear(sin_dilation_)),
      dilation_end_(d.softening.dilation_limit(d.dilation_limit)),
      fall_(d.softening) {
  const Cone matched = cone(d);
  eta_ = matched.eta;
  eta_bar_ = matched.eta_bar;
  strength_ = matched.xi * d.cohesion;
  apex_ = eta_ > 0.0 ? strength_ / eta_ : std::numeric_limits<double>::infinity();
  tension_ = d.tension_cutoff < 0.0 ? std::numeric_limits<double>::infinity() : d.tension_cutoff;
  cutoff_ = std::min(tension_, apex_);
  // Soil that has opened, or dilated to its limit, flows without dilation.
  flow_ = std::max(largest_flow_stiffness(false), largest_flow_stiffness(true));
  if (!fall_.falls()) return;
  const DruckerPragerDefinition residual = weakened(d, 0.0);
  const Cone last = cone(residual);
  eta_fall_ = follows_lode_ ? Fall{sin_friction_, std::sin(residual.friction_angle)} : Fall{matched.eta, last.eta};
  strength_fall_ = follows_lode_ ? Fall{d.cohesion * std::cos(d.friction_angle),
                                        residual.cohesion * std::cos(residual.friction_angle)}
                                 : Fall{strength_, last.xi * residual.cohesion};
  for (const double left : kPartsOfAFall) flow_ = std::max(flow_, DruckerPrager(weakened(d, left), density).flow_);
}

/// Largest flow_stiffness() of all stresses. In principal axes the flow is m = s / (2 sqrt(J2)) + eta_bar / 3, and the
/// normal that of the cone or Mohr-Coulomb's, (1 + sin(phi), 0, -1 + sin(phi)) / 2. Lode angles are sampled; the
/// largest values, in triaxial compression and extension, are among them.
double DruckerPrager::largest_flow_stiffness(bool dilates) const {
  constexpr int kAngles = 60;
  const double third = 2.0 / 3.0 * kPi, s = sin_friction_, lame = bulk_ - 2.0 / 3.0 * shear_;
  double most = 0.0;
  for (int k = 0; k <= kAngles; ++k) {
    const double angle = 0.5 * third * k / kAngles, scale = 2.0 / std::sqrt(3.0);
    // Over sqrt(J2), in descending order.
    const PrincipalValues s_over{scale * std::cos(angle), scale * std::cos(angle - third),
                                 scale * std::cos(angle + third)};
    double eta_bar = eta_bar_, h = 0.0;
    PrincipalValues normal;
    if (follows_lode_) {
      const std::pair<double, double> extremes{s_over[0], s_over[2]};
      eta_bar = sin_dilation_ / shear_measure(extremes, sin_dilation_);
      normal = {lame * s + shear_ * (1.0 + s), lame * s, lame * s - shear_ * (1.0 - s)};
      h = shear_ * shear_measure(extremes, s) + (dilates ? bulk_ * eta_bar * s : 0.0);
    } else {
      for (int i = 0; i < 3; ++i) normal[i] = bulk_ * eta_ + shear_ * s_over[i];
      h = shear_ + (dilates ? bulk_ * eta_bar * eta_ : 0.0);
    }
    PrincipalValues flow;
    for (int i = 0; i < 3; ++i) flow[i] = (dilates ? bulk_ * eta_bar : 0.0) + shear_ * s_over[i];
    most = std::max(most, flow_stiffness(flow, normal, h));
  }
  return most;
}

double friction_in_plane_strain(const DruckerPragerDefinition& d) {
  if (d.match == ConeMatch::mohr_coulomb) return std::sin(d.friction_angle);
  const Cone matched = cone(d);
  const double a = std::sqrt(std::max(0.0, 1.0 - matched.eta_bar * matched.eta_bar / 3.0));
  return a * matched.eta / (1.0 - matched.eta * matched.eta_bar / 3.0);
}

std::optional<double> friction_in_plane_strain(const LawDefinition& law) {
  const auto* soil = std::get_if<DruckerPragerDefinition>(&law);
  if (soil == nullptr) return std::nullopt;
  return friction_in_plane_strain(*soil);
}

}  // namespace mpm
