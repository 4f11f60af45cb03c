// Principal values and directions of small symmetric tensors. Cyclic Jacobi rotations in three dimensions: exact to
// round-off for equal and nearly equal values too, where the closed form with a cosine loses half of the digits. They
// take single numbers only, because the number of rotations differs too much from tensor to tensor for wide registers.
// For registers there are the extreme values in closed form, and bounds on them. Source: Golub & Van Loan, Matrix
// Computations, section 8.5.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mpm/math/tensor.hpp"

namespace mpm {

/// s = sum of value[k] direction[k] (x) direction[k], in no particular order; directions have unit length.
template <class T>
struct Principal {
  T value[3];
  T direction[3][3];
  T largest() const { return std::max(value[0], std::max(value[1], value[2])); }
  T smallest() const { return std::min(value[0], std::min(value[1], value[2])); }
};

template <class T>
Principal<T> principal(const Symmetric3<T>& s) {
  T a[3][3] = {{s.xx, s.xy, s.xz}, {s.xy, s.yy, s.yz}, {s.xz, s.yz, s.zz}};
  Principal<T> result{{}, {{T(1), T(0), T(0)}, {T(0), T(1), T(0)}, {T(0), T(0), T(1)}}};
  constexpr int kSweeps = 12;  // six reach round-off for any tensor
  const T round_off = T(0.125) * std::numeric_limits<T>::epsilon() * std::sqrt(squared_norm(s));
  const auto none = [&](int i, int j) { return std::abs(a[i][j]) <= round_off; };
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    if (none(0, 1) && none(0, 2) && none(1, 2)) break;
    for (int pair = 0; pair < 3; ++pair) {  // 0 and 1, 0 and 2, 1 and 2
      const int i = pair / 2, j = (pair + 3) / 2;
      const T shear = a[i][j];
      if (none(i, j)) continue;
      const T theta = (a[j][j] - a[i][i]) / (T(2) * shear);
      const T t = (theta < T(0) ? T(-1) : T(1)) / (std::abs(theta) + std::sqrt(theta * theta + T(1)));
      const T cosine = T(1) / std::sqrt(t * t + T(1)), sine = t * cosine;
      const int k = 3 - i - j;
      const T ik = a[i][k], jk = a[j][k];
      a[i][i] -= t * shear;
      a[j][j] += t * shear;
      a[i][j] = a[j][i] = T(0);
      a[i][k] = a[k][i] = cosine * ik - sine * jk;
      a[j][k] = a[k][j] = sine * ik + cosine * jk;
      for (int c = 0; c < 3; ++c) {
        const T di = result.direction[i][c], dj = result.direction[j][c];
        result.direction[i][c] = cosine * di - sine * dj;
        result.direction[j][c] = sine * di + cosine * dj;
      }
    }
  }
  for (int k = 0; k < 3; ++k) result.value[k] = a[k][k];
  return result;
}

/// cos(2/3 acos(x)), x in [0, 1], to 7e-11: the best polynomial of degree 10 that is exact at both ends. It is the
/// cosine of a third of an angle whose half has the cosine x.
template <class T>
T cosine_of_third_by_half(T x) {
  constexpr double kCoefficients[] = {0.5773502579638301,     -0.11111053153487353,  0.0534479303418112,
                                      -0.03282778829327735,   0.022371269031830295,  -0.015390173416510873,
                                      0.009525606451258505,   -0.004605221387203654, 0.0014566854967688577,
                                      -0.00021803465363359558};
  T sum(0);
  for (int k = 9; k >= 0; --k) sum = x * (sum + T(kCoefficients[k]));
  return T(0.5) + sum;
}

/// sin^2 of three times the Lode angle of a deviator d with d : d = 6, where `cosine` = determinant(d) / 2 is the
/// cosine: the square of what dev(d d) has beside its part along d, |dev(d d) - cosine d|^2 / 6. Exact to round-off
/// where two principal values are nearly equal too, where 1 - cos^2 has lost half of the digits.
template <class T>
T squared_sine_of_lode(const Symmetric3<T>& d, T cosine) {
  const Symmetric3<T> square = {d.xx * d.xx + d.xy * d.xy + d.xz * d.xz, d.xy * d.xy + d.yy * d.yy + d.yz * d.yz,
                                d.xz * d.xz + d.yz * d.yz + d.zz * d.zz, d.xy * d.xz + d.yy * d.yz + d.yz * d.zz,
                                d.xx * d.xz + d.xy * d.yz + d.xz * d.zz, d.xx * d.xy + d.xy * d.yy + d.xz * d.yz};
  return T(1.0 / 6.0) *
         squared_norm(sum(scale_shift(square, T(1), T(-1.0 / 3.0) * trace(square)), scale_shift(d, -cosine, T(0))));
}

/// Halves of the largest and of the smallest principal value of a deviator d with d : d = 6, the latter with its sign
/// turned; both lie between 1/2 and 1. To 1e-10 (in single precision 1e-6). T: a number or a register. Source: Smith
/// (1961), Commun. ACM 4, with the Lode angle from its sine where its cosine is near 1 or -1.
template <class T>
std::pair<T, T> half_extremes(const Symmetric3<T>& d) {
  const T cosine = T(0.5) * determinant(d);
  const T squared_most = T(0.5) + T(0.5) * min(abs(cosine), T(1));  // cosine of the half of the smaller angle
  const T most = sqrt(squared_most);
  const T least = min(T(0.5) * sqrt(squared_sine_of_lode(d, cosine) / squared_most), T(1));
  const T far = cosine_of_third_by_half(most), near = cosine_of_third_by_half(least);
  const auto extends = cosine >= T(0);
  return {select(extends, far, near), select(extends, near, far)};
}

/// The largest and the smallest principal value in closed form, at a fraction of the cost of principal(): to 1e-10 of
/// the deviator's norm (in single precision 1e-6). T: a number or a register.
template <class T>
std::pair<T, T> principal_extremes(const Symmetric3<T>& s) {
  const T mean = T(1.0 / 3.0) * trace(s);
  const Symmetric3<T> deviator = scale_shift(s, T(1), -mean);
  const T size = sqrt(T(1.0 / 6.0) * squared_norm(deviator));
  constexpr float kAlmostNothing = std::numeric_limits<float>::min();  // avoids 0 / 0 where the deviator is zero
  const auto half = half_extremes(scale_shift(deviator, T(1) / max(size, T(kAlmostNothing)), T(0)));
  return {mean + T(2) * size * half.first, mean - T(2) * size * half.second};
}

/// Planar overload, exact to round-off.
template <class T>
std::pair<T, T> principal_extremes(const SymmetricPlane<T>& s) {
  const T mean = T(0.5) * (s.xx + s.zz), half = T(0.5) * (s.xx - s.zz);
  const T radius = sqrt(half * half + s.xz * s.xz);
  return {max(mean + radius, s.yy), min(mean - radius, s.yy)};
}

/// Planar overload, exact to round-off.
template <class T>
std::pair<T, T> half_extremes(const SymmetricPlane<T>& d) {
  const auto [largest, smallest] = principal_extremes(d);
  return {T(0.5) * largest, T(-0.5) * smallest};
}

/// An upper bound of cos(acos(c)/3), at most 3e-5 above it; c in [-1, 1]. With x = sqrt((1 + c)/2) the function is
/// cos(2/3 acos(x)), smooth on [0, 1]; the bound is its best polynomial of degree 4 (error 8.3e-6), raised above it.
template <class T>
T cosine_of_third_bound(T c) {
  // At c = -1, where the slope is infinite, round-off of c must not lower the bound.
  constexpr double kRoundOff = 16.0 * std::numeric_limits<ScalarOf<T>>::epsilon();
  const T x = sqrt(T(0.5) * (max(min(c, T(1)), T(-1)) + T(1.0 + kRoundOff)));
  return T(0.50002) + x * (T(0.576883) + x * (T(-0.106839) + x * (T(0.038898) - T(0.008959) * x)));
}

/// Bounds {upper, lower} of the principal values: not below the largest and not above the smallest, and off by at most
/// 1e-4 (in single precision 2e-3) of the deviator's norm. T: a number or a register. Source: Smith (1961), as above,
/// without trigonometric functions.
template <class T>
std::pair<T, T> principal_bounds(const Symmetric3<T>& s) {
  const T mean = T(1.0 / 3.0) * trace(s);
  const Symmetric3<T> deviator = scale_shift(s, T(1), -mean);
  const T size = sqrt(T(1.0 / 6.0) * squared_norm(deviator));
  constexpr float kAlmostNothing = std::numeric_limits<float>::min();  // avoids 0 / 0 where the deviator is zero
  const T cosine = T(0.5) * determinant(scale_shift(deviator, T(1) / max(size, T(kAlmostNothing)), T(0)));
  return {mean + T(2) * size * cosine_of_third_bound(cosine), mean - T(2) * size * cosine_of_third_bound(-cosine)};
}

/// Planar overload, exact to round-off.
template <class T>
std::pair<T, T> principal_bounds(const SymmetricPlane<T>& s) {
  return principal_extremes(s);
}

/// The third value is yy, that of the direction out of the plane.
template <class T>
Principal<T> principal(const SymmetricPlane<T>& s) {
  T cosine = T(1), sine = T(0), xx = s.xx, zz = s.zz;
  if (s.xz != T(0)) {
    const T theta = (s.zz - s.xx) / (T(2) * s.xz);
    const T t = (theta < T(0) ? T(-1) : T(1)) / (std::abs(theta) + std::sqrt(theta * theta + T(1)));
    cosine = T(1) / std::sqrt(t * t + T(1));
    sine = t * cosine;
    xx -= t * s.xz;
    zz += t * s.xz;
  }
  return {{xx, zz, s.yy}, {{cosine, T(0), -sine}, {sine, T(0), cosine}, {T(0), T(1), T(0)}}};
}

/// The tensor with these principal values and directions, of the type of the second argument.
template <class T>
Symmetric3<T> compose(const Principal<T>& p, const Symmetric3<T>&) {
  Symmetric3<T> s{};
  for (int k = 0; k < 3; ++k) {
    const T* d = p.direction[k];
    const T v = p.value[k];
    s = sum(s, {v * d[0] * d[0], v * d[1] * d[1], v * d[2] * d[2], v * d[1] * d[2], v * d[0] * d[2], v * d[0] * d[1]});
  }
  return s;
}

template <class T>
SymmetricPlane<T> compose(const Principal<T>& p, const SymmetricPlane<T>&) {
  const T cosine = p.direction[0][0], sine = p.direction[1][0];
  const T a = p.value[0], b = p.value[1];
  return {a * cosine * cosine + b * sine * sine, a * sine * sine + b * cosine * cosine, (b - a) * sine * cosine,
          p.value[2]};
}

}  // namespace mpm
