#include "mpm/crack/crack_tip_field.hpp"

#include <cmath>

#include "mpm/math/constants.hpp"

namespace mpm {

TipFieldValue CrackTipField::at(const Vec2& place) const {
  const double g = constants_.shear_modulus(), kappa = constants_.kappa();
  const double radius = place.norm(), angle = std::atan2(place.y(), place.x());
  const double c = std::cos(0.5 * angle), s = std::sin(0.5 * angle);
  const double c3 = std::cos(1.5 * angle), s3 = std::sin(1.5 * angle);
  TipFieldValue value;

  // u = sqrt(r / 2 pi) / (2 G) f(angle); `turn` is df / d(angle).
  const Vec2 f(k_.one * c * (kappa - 1.0 + 2.0 * s * s) + k_.two * s * (kappa + 1.0 + 2.0 * c * c),
               k_.one * s * (kappa + 1.0 - 2.0 * c * c) - k_.two * c * (kappa - 1.0 - 2.0 * s * s));
  const Vec2 turn(k_.one * (2.0 * s * c * c - 0.5 * s * (kappa - 1.0 + 2.0 * s * s)) +
                      k_.two * (0.5 * c * (kappa + 1.0 + 2.0 * c * c) - 2.0 * s * s * c),
                  k_.one * (0.5 * c * (kappa + 1.0 - 2.0 * c * c) + 2.0 * s * s * c) +
                      k_.two * (0.5 * s * (kappa - 1.0 - 2.0 * s * s) + 2.0 * s * c * c));
  const double scale = std::sqrt(radius / (2.0 * kPi)) / (2.0 * g);
  const Vec2 outward = place / radius, around(-outward.y(), outward.x());
  value.displacement = scale * f;
  value.gradient = scale / radius * (0.5 * f * outward.transpose() + turn * around.transpose());

  const double near = 1.0 / std::sqrt(2.0 * kPi * radius);
  const double shear = near * (k_.one * s * c * c3 + k_.two * c * (1.0 - s * s3));
  value.stress << near * (k_.one * c * (1.0 - s * s3) - k_.two * s * (2.0 + c * c3)) + t_stress_, shear, shear,
      near * (k_.one * c * (1.0 + s * s3) + k_.two * s * c * c3);

  const Vec2 strain(t_stress_ * (kappa + 1.0) / (8.0 * g), -t_stress_ * (3.0 - kappa) / (8.0 * g));
  value.displacement += strain.cwiseProduct(place);
  value.gradient.diagonal() += strain;
  if (!constants_.plane_stress) value.stress_out = constants_.poisson * value.stress.trace();
  return value;
}

}  // namespace mpm
