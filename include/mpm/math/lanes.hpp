// Arithmetic that is written once for a number and for a wide register of numbers (kernel/wide.hpp). What would be a
// branch on a value is a select() between two results, or an any() that skips work which no lane needs.
//
// Call the functions below without std::, so that those of a register are found by its type.
#pragma once

#include <algorithm>
#include <cmath>

namespace mpm {

using std::abs;
using std::exp;
using std::log;
using std::max;
using std::min;
using std::pow;
using std::sqrt;

/// x^(-1/3), x > 0
inline double inverse_cbrt(double x) { return 1.0 / std::cbrt(x); }
inline float inverse_cbrt(float x) { return 1.0F / std::cbrt(x); }

/// Where `which`, a; elsewhere b. Both are computed.
template <class T>
T select(bool which, T a, T b) {
  return which ? a : b;
}
/// Whether it holds in any lane.
inline bool any(bool which) { return which; }
/// Whether it holds in every lane.
inline bool all(bool which) { return which; }

}  // namespace mpm
