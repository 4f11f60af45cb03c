// Openings in soil: the amount by which soil has opened is stored, and soil must close again before it carries
// pressure. Otherwise every opening would turn into spurious stress on the way back. Shared by the laws of soil.
#pragma once

#include <array>

#include "mpm/material/linear_elastic.hpp"

namespace mpm {

/// A mean stress below this part of the bulk modulus counts as zero.
constexpr double kStressFree = 1e-9;

/// Lets pressure close the opening first. `mean`: trial mean stress, tension positive [Pa]; `opening`: logarithmic
/// volume, >= 0, which is reduced by the closing; `bulk` [Pa]. Returns the remaining mean stress [Pa].
template <class T>
T close_opening(T mean, double bulk, T& opening) {
  const T left = min(mean + T(bulk) * opening, max(mean, T(0)));
  opening = max(opening + T(1.0 / bulk) * min(mean, T(0)), T(0));
  return left;
}

/// Part of the dilation left at the volume j over the initial one: all of it, and none from 1 + `limit` on, falling in
/// a straight line over the last tenth of the limit.
class DilationEnd {
 public:
  explicit DilationEnd(double limit);
  template <class T>
  T left(T j) const {
    return max(min(T(start_) - T(slope_) * j, T(1)), T(0));
  }
  double start() const { return start_; }
  double slope() const { return slope_; }

 private:
  double start_, slope_;  ///< start and slope of the straight line
};

/// Principal values of a tensor [Pa].
using PrincipalValues = std::array<double, 3>;
/// Largest contribution of flow C - P Q / h to the eigenvalues of the acoustic tensor [Pa], P = C m and Q = C f for the
/// flow direction m and the yield surface's normal f, h = f C m [Pa]. In the direction n of a wave, p = P n and q = Q n
/// raise them by at most (|p||q| - p q) / 2h, which is at most |w p - q/w|^2 / 4h for any w; the best w is used.
double flow_stiffness(const PrincipalValues& p, const PrincipalValues& q, double h);

/// Upper bound of the speed of small waves [m/s]. Loose soil (j > 1) without pressure carries no wave until it has
/// closed, and then has its initial density. `flow`: largest contribution of plastic flow to rho c^2 [Pa], positive if
/// the flow is not associated. It counts whether the soil flows or not: what yields within a sync period would else be
/// above the step chosen at its start.
template <class T, class Symmetric>
T soil_wave_speed(const Symmetric& tau, T j, double bulk, double shear, double density, double flow) {
  const auto carries = abs(trace(tau)) > T(3.0 * kStressFree * bulk / density);
  const T closed = select((j > T(1)) & !carries, T(1), j);
  return LinearElastic::tangent_wave_speed(tau, closed, bulk, shear, density, T(flow));
}

}  // namespace mpm
