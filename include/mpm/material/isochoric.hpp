// The isochoric left Cauchy-Green tensor b of an elastic strain, det b = 1, determined by its deviator alone, so that
// laws with s = G dev b need not store b beside the stress. tr(b)/3 = 1 + x follows from det(dev b + (1 + x) I) = 1,
// with the invariants J2 = dev b : dev b / 2 and J3 = det dev b:
//
//   x (3 + 3 x + x^2 - J2) = J2 - J3
//
// Stored energy is G/2 (tr b - 3) = 3/2 G x; x instead of the trace keeps all digits at small strain. Newton's method
// finds it; the slope at the root is the second invariant of b, at least 3.
#pragma once

#include <limits>

#include "mpm/math/principal.hpp"

namespace mpm {

/// ln(s) / 2, s symmetric and positive: the logarithmic strain of b = s.
Symmetric3<double> half_logarithm(const Symmetric3<double>& s);

/// Elastic logarithmic strain of a law with s = G dev b and the whole volume J; `tau`: Kirchhoff stress over initial
/// density [J/kg], `scale`: that density over G [kg/J].
Symmetric3<double> isochoric_strain(const Symmetric3<double>& tau, double j, double scale);

/// x, the largest root of the equation above.
template <class T>
T isochoric_excess(T j2, T j3) {
  // The first guess is close to the root at small strain and above it at large strain, since no eigenvalue of the
  // deviator is below -2 sqrt(J2/3). Wherever the slope is positive, convexity makes Newton's steps monotone from the
  // second on.
  T x = T(1.0 / 3.0) * (j2 - select(j2 < T(1), j3, T(0)));
  const auto large = j2 >= T(12);
  if (any(large)) x = select(large, T(2) * sqrt(T(1.0 / 3.0) * j2), x);
  constexpr int kSteps = 20;  // stretch ratios of 1e3 need twelve steps, metals one
  constexpr double kRoundOff = 0.25 * std::numeric_limits<ScalarOf<T>>::epsilon();
  auto open = j2 >= T(0);
  for (int i = 0; i < kSteps && any(open); ++i) {
    const T slope = T(3) * (T(1) + x) * (T(1) + x) - j2;
    const T step = select(open, (x * (T(3) + T(3) * x + x * x - j2) + j3 - j2) / slope, T(0));
    x -= step;
    // The next step would be the square of this one times half the curvature, 3 (1 + x), divided by the slope.
    open = open & (T(3) * (T(1) + x) * step * step > T(kRoundOff) * x * slope);
  }
  return x;
}

template <class Symmetric>
auto isochoric_excess(const Symmetric& deviator) {
  using T = decltype(trace(deviator));
  return isochoric_excess<T>(T(0.5) * squared_norm(deviator), determinant(deviator));
}

/// dev(J^(-2/3) F F^T): dev b where the whole deformation F is elastic.
template <class T, class Matrix>
auto isochoric_deviator(const Matrix& f, T j) {
  const auto b = left_cauchy_green(f);
  const T root = inverse_cbrt(j);
  const T scale = root * root;
  return scale_shift(b, scale, T(-1.0 / 3.0) * scale * trace(b));
}

/// Advances dev b over an increment, b <- J^(-2/3) df b df^T with J = det df. `excess` is x at the increment's start.
template <class T, class Matrix, class Symmetric>
Symmetric stretch_isochoric(const Matrix& df, T det, const Symmetric& deviator, T excess) {
  const T root = inverse_cbrt(det);
  const Symmetric b = congruence(df, scale_shift(deviator, T(1), T(1) + excess));
  const T scale = root * root;
  return scale_shift(b, scale, T(-1.0 / 3.0) * scale * trace(b));
}

/// Modulus [Pa] of a radial return of s = G dev b: the Mises stress removed by the return, divided by the modulus, is
/// the plastic strain, and this times the Mises stress is the elastic energy released. J2, J3 and x are those of dev b
/// before the return. The modulus is 2 G J2 I2 / (I1 I2 - 9) with the invariants I1, I2 of b, where I1 I2 - 9 = 2 J2 I1
/// - 9 J3; it is 3 G at small strain.
template <class T>
T return_modulus(T shear, T j2, T j3, T excess) {
  const T mean = T(1) + excess;
  return T(2) * shear * j2 * (T(3) * mean * mean - j2) / (T(2) * mean * j2 - T(3) * j3);
}

/// Upper bound of rho c^2 [Pa] over all waves in all directions n, from the acoustic tensor of tau = G dev b,
///   (G/J) [(n.bn) I - 2/3 (bn n + n bn) + 5/9 tr(b) n n],
/// plus `bulk` [Pa] for the part along n; found from the parts along n, across it and between the two (Gershgorin).
/// `gb`: (G/J) b [Pa]; for parallel springs the sum.
template <class T, class Symmetric>
T stiffest_wave(const Symmetric& gb, T bulk) {
  const auto [largest, smallest] = principal_bounds(gb);
  const T along = bulk + T(5.0 / 9.0) * trace(gb) - T(1.0 / 3.0) * smallest;
  return max(along, largest) + T(1.0 / 3.0) * (largest - smallest);
}

}  // namespace mpm
