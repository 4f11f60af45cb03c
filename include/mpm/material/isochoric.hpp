// The isochoric left Cauchy-Green tensor b of an elastic strain, det b = 1, known by its deviator alone: laws with
// s = G dev b need not store b beside the stress. tr(b)/3 = 1 + x follows from det(dev b + (1 + x) I) = 1, with the
// invariants J2 = dev b : dev b / 2 and J3 = det dev b:
//
//   x (3 + 3 x + x^2 - J2) = J2 - J3
//
// Stored energy is G/2 (tr b - 3) = 3/2 G x: x instead of the trace keeps all digits at small strain. Newton's method
// finds it: the slope at the root is the second invariant of b, at least 3.
#pragma once

#include <algorithm>
#include <cmath>

#include "mpm/math/principal.hpp"

namespace mpm {

/// x, the largest root of the equation above.
template <class T>
T isochoric_excess(T j2, T j3) {
  // Above the root, since no eigenvalue of the deviator is below -2 sqrt(J2/3); close to it at small strain. Convexity
  // makes Newton's steps monotone from the second on.
  T x = j2 < T(12) ? j2 / T(3) : T(2) * std::sqrt(j2 / T(3));
  constexpr int kSteps = 20;  // stretch ratios of 1e3 need twelve, metals two
  for (int i = 0; i < kSteps; ++i) {
    const T slope = T(3) * (T(1) + x) * (T(1) + x) - j2;
    const T step = (x * (T(3) + T(3) * x + x * x - j2) + j3 - j2) / slope;
    x -= step;
    if (std::abs(step) <= T(1e-9) * x) break;  // the next step is the square of this one
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
  const T root = std::cbrt(j);
  const T scale = T(1) / (root * root);
  return scale_shift(b, scale, -scale * trace(b) / T(3));
}

/// Deviator of b from that of the increment's start: b <- J^(-2/3) df b df^T with J = det df.
template <class T, class Matrix, class Symmetric>
Symmetric stretch_isochoric(const Matrix& df, T det, const Symmetric& deviator) {
  const T root = std::cbrt(det);
  const Symmetric b = congruence(df, scale_shift(deviator, T(1), T(1) + isochoric_excess(deviator)));
  const T scale = T(1) / (root * root);
  return scale_shift(b, scale, -scale * trace(b) / T(3));
}

/// Bounds over all directions n of a wave on the acoustic tensor of tau = G dev b,
///   (G/J) [(n.bn) I - 2/3 (bn n + n bn) + 5/9 tr(b) n n],
/// by the parts along n, across it and between the two [Pa]. Add them for springs side by side.
struct ShearWaves {
  double along = 0.0, across = 0.0, coupling = 0.0;

  ShearWaves() = default;
  /// `shear`: G/J [Pa]
  ShearWaves(const Symmetric3<double>& b, double shear) {
    const auto [largest, smallest] = principal_extremes(b);
    along = shear * (5.0 / 9.0 * trace(b) - smallest / 3.0);
    across = shear * largest;
    coupling = shear * (largest - smallest) / 3.0;
  }
  friend ShearWaves operator+(ShearWaves a, const ShearWaves& b) {
    a.along += b.along;
    a.across += b.across;
    a.coupling += b.coupling;
    return a;
  }
  /// No wave has a larger rho c^2 [Pa] (Gershgorin); `bulk` comes to the part along n.
  double stiffest(double bulk) const { return std::max(bulk + along, across) + coupling; }
};

}  // namespace mpm
