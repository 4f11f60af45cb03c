// Logarithm and power of single numbers on a device, by the solver's own of a register (kernel/wide_math.hpp), for the
// energy of laws. For clang, in sources of laws: after their headers.
#pragma once

#include "mpm/kernel/wide.hpp"
#include "mpm/kernel/wide_math.hpp"

namespace std {
__attribute__((device)) inline double log(double x) { return mpm::log(mpm::Wide<double>(x)).v; }
__attribute__((device)) inline double pow(double x, double y) {
  return mpm::pow(mpm::Wide<double>(x), mpm::Wide<double>(y)).v;
}
}  // namespace std
