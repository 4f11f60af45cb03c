// Soil that has opened remembers by how much, and must close again before it carries pressure; otherwise every opening
// would turn into spurious stress on the way back. Shared by the laws of soil.
#pragma once

#include "mpm/material/linear_elastic.hpp"

namespace mpm {

/// Of the bulk modulus: a smaller mean stress is none.
constexpr double kStressFree = 1e-9;
/// Of its strength: where a soil counts as flowing, for the wave speed.
constexpr double kNearYield = 0.9;

/// Closes what pressure there is room for. `mean`: trial mean stress, tension positive [Pa]; `opening`: logarithmic
/// volume, >= 0, reduced by what closes. Gives what is left of the mean stress; `bulk` [Pa].
template <class T>
T close_opening(T mean, double bulk, T& opening) {
  const T left = min(mean + T(bulk) * opening, max(mean, T(0)));
  opening = max(opening + T(1.0 / bulk) * min(mean, T(0)), T(0));
  return left;
}

/// Bound on the fastest small wave [m/s]. Loose soil (j > 1) without pressure carries none until it has closed, and is
/// as dense as at the start then. `flow`: what plastic flow adds to rho c^2 where it goes on [Pa]; more than nothing
/// for a flow that is not associated: with p = C m n and q = C f n of the flow m and the yield surface's normal f, the
/// acoustic tensor is Q - p q / h, h = f C m, whose eigenvalues exceed those of Q by (|p - q|/2)^2 / h at most.
template <class T, class Symmetric>
T soil_wave_speed(const Symmetric& tau, T j, double bulk, double shear, double density, T flow) {
  const auto bears = abs(trace(tau)) > T(3.0 * kStressFree * bulk / density);
  const T closed = select((j > T(1)) & !bears, T(1), j);
  return LinearElastic::tangent_wave_speed(tau, closed, bulk, shear, density, flow);
}

}  // namespace mpm
