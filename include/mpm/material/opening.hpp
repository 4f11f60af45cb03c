// Openings in soil: the amount by which soil has opened is stored, and soil must close again before it carries
// pressure. Otherwise every opening would turn into spurious stress on the way back. Shared by the laws of soil.
#pragma once

#include "mpm/material/linear_elastic.hpp"

namespace mpm {

/// A mean stress below this part of the bulk modulus counts as zero.
constexpr double kStressFree = 1e-9;
/// Soil counts as flowing above this part of its strength, for the wave speed.
constexpr double kNearYield = 0.9;

/// Lets pressure close the opening first. `mean`: trial mean stress, tension positive [Pa]; `opening`: logarithmic
/// volume, >= 0, which is reduced by the closing; `bulk` [Pa]. Returns the remaining mean stress [Pa].
template <class T>
T close_opening(T mean, double bulk, T& opening) {
  const T left = min(mean + T(bulk) * opening, max(mean, T(0)));
  opening = max(opening + T(1.0 / bulk) * min(mean, T(0)), T(0));
  return left;
}

/// Upper bound of the speed of small waves [m/s]. Loose soil (j > 1) without pressure carries no wave until it has
/// closed, and then has its initial density. `flow`: contribution of ongoing plastic flow to rho c^2 [Pa], positive if
/// the flow is not associated. With p = C m and q = C f applied to n, for the flow direction m and the yield surface's
/// normal f, the acoustic tensor is Q - p q / h, h = f C m, whose eigenvalues exceed those of Q by at most (|p -
/// q|/2)^2 / h.
template <class T, class Symmetric>
T soil_wave_speed(const Symmetric& tau, T j, double bulk, double shear, double density, T flow) {
  const auto carries = abs(trace(tau)) > T(3.0 * kStressFree * bulk / density);
  const T closed = select((j > T(1)) & !carries, T(1), j);
  return LinearElastic::tangent_wave_speed(tau, closed, bulk, shear, density, flow);
}

}  // namespace mpm
