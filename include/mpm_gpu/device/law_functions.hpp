// Logarithms and powers of single numbers on a device, by the solver's own of a register (kernel/wide_math.hpp), for
// the energy of laws. For clang, in sources of laws: after their headers.
#pragma once

#include "mpm/kernel/wide.hpp"
#include "mpm/kernel/wide_math.hpp"

namespace std {
__attribute__((device)) inline double log(double x) { return mpm::log(mpm::Wide<double>(x)).v; }
__attribute__((device)) inline double pow(double x, double y) {
  return mpm::pow(mpm::Wide<double>(x), mpm::Wide<double>(y)).v;
}
__attribute__((device)) inline double exp(double x) { return mpm::exp(mpm::Wide<double>(x)).v; }
__attribute__((device)) inline double cbrt(double x) {
  const double inverse = mpm::inverse_cbrt(mpm::Wide<double>(x)).v;
  return x * inverse * inverse;
}
// Digits that 1 + x and exp(x) lose of a small number are made good by the number that they keep (Higham, Accuracy and
// Stability of Numerical Algorithms, 1.14.1).
__attribute__((device)) inline double log1p(double x) {
  const double sum = 1.0 + x;
  return sum == 1.0 ? x : log(sum) * (x / (sum - 1.0));
}
__attribute__((device)) inline double expm1(double x) {
  const double power = mpm::exp(mpm::Wide<double>(x)).v;
  return power == 1.0 ? x : !(power > 0.0) ? -1.0 : (power - 1.0) * (x / log(power));
}
}  // namespace std
