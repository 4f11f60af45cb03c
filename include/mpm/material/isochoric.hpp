// The isochoric left Cauchy-Green tensor b of an elastic strain, det b = 1, known by its deviator alone: laws with
// s = G dev b need not store b beside the stress. tr(b)/3 = 1 + x follows from det(dev b + (1 + x) I) = 1, with the
// invariants J2 = dev b : dev b / 2 and J3 = det dev b:
//
//   x (3 + 3 x + x^2 - J2) = J2 - J3
//
// Stored energy is G/2 (tr b - 3) = 3/2 G x: x instead of the trace keeps all digits at small strain. Newton's method
// finds it: the slope at the root is the second invariant of b, at least 3.
#pragma once

#include <limits>

#include "mpm/math/principal.hpp"

namespace mpm {

/// x, the largest root of the equation above.
template <class T>
T isochoric_excess(T j2, T j3) {
  // Close to the root at small strain; above it at large strain, since no eigenvalue of the deviator is below
  // -2 sqrt(J2/3). Wherever the slope is positive, convexity makes Newton's steps monotone from the second on.
  T x = T(1.0 / 3.0) * (j2 - select(j2 < T(1), j3, T(0)));
  const auto large = j2 >= T(12);
  if (any(large)) x = select(large, T(2) * sqrt(T(1.0 / 3.0) * j2), x);
  constexpr int kSteps = 20;  // stretch ratios of 1e3 need twelve, metals one
  constexpr double kRoundOff = 0.25 * std::numeric_limits<ScalarOf<T>>::epsilon();
  auto open = j2 >= T(0);
  for (int i = 0; i < kSteps && any(open); ++i) {
    const T slope = T(3) * (T(1) + x) * (T(1) + x) - j2;
    const T step = select(open, (x * (T(3) + T(3) * x + x * x - j2) + j3 - j2) / slope, T(0));
    x -= step;
    // The next step would be the square of this one times half of the curvature, 3 (1 + x), over the slope.
    open = open & (T(3) * (T(1) + x) * step * step > T(kRoundOff) * x * slope);
  }
  return x;
}

template <class Symmetric>
auto isochoric_excess(const Symmetric& deviator) {
  using T = decltype(trace(deviator));
  return isochoric_excess<T>(T(0.5) * squared_norm(deviator), determinant(deviator));
}

/// dev(J^(-2/3) F F^T): of a strain that is all elastic.
template <class T, class Matrix>
auto isochoric_deviator(const Matrix& f, T j) {
  const auto b = left_cauchy_green(f);
  const T root = inverse_cbrt(j);
  const T scale = root * root;
  return scale_shift(b, scale, T(-1.0 / 3.0) * scale * trace(b));
}

/// Deviator of b from that of the increment's start, whose x is `excess`: b <- J^(-2/3) df b df^T with J = det df.
template <class T, class Matrix, class Symmetric>
Symmetric stretch_isochoric(const Matrix& df, T det, const Symmetric& deviator, T excess) {
  const T root = inverse_cbrt(det);
  const Symmetric b = congruence(df, scale_shift(deviator, T(1), T(1) + excess));
  const T scale = root * root;
  return scale_shift(b, scale, T(-1.0 / 3.0) * scale * trace(b));
}

/// Modulus [Pa] of a radial return of s = G dev b: plastic strain is the Mises stress that the return takes, over it,
/// and times Mises stress it is the elastic energy that the return releases. J2, J3 and x are of dev b at its start. It
/// is 2 G J2 I2 / (I1 I2 - 9) with the invariants I1, I2 of b, where I1 I2 - 9 = 2 J2 I1 - 9 J3; 3 G at small strain.
template <class T>
T return_modulus(T shear, T j2, T j3, T excess) {
  const T mean = T(1) + excess;
  return T(2) * shear * j2 * (T(3) * mean * mean - j2) / (T(2) * mean * j2 - T(3) * j3);
}

/// Bound on rho c^2 of all waves in all directions n [Pa], of the acoustic tensor of tau = G dev b,
///   (G/J) [(n.bn) I - 2/3 (bn n + n bn) + 5/9 tr(b) n n],
/// and of what comes to the part along n [Pa], `bulk`; by the parts along n, across it and between the two
/// (Gershgorin). `gb`: (G/J) b [Pa], of springs side by side the sum.
template <class T, class Symmetric>
T stiffest_wave(const Symmetric& gb, T bulk) {
  const auto [largest, smallest] = principal_bounds(gb);
  const T along = bulk + T(5.0 / 9.0) * trace(gb) - T(1.0 / 3.0) * smallest;
  return max(along, largest) + T(1.0 / 3.0) * (largest - smallest);
}

}  // namespace mpm
