// Arithmetic that is written once for a number and for a wide register of numbers (kernel/wide.hpp). What would be a
// branch on a value is a select() between two results, or an any() that skips work which no lane needs.
//
// Call the functions below without std::, so that those of a register are found by its type. Masks, what comparisons
// give, combine with & | ! alone, which suit bool too. A register type has what a number has, made from a double by
// T(x), with a default constructor, and besides
//
//   static constexpr int kLanes;
//   friend select, any, all, sqrt, abs, max, min, exp, log, pow, inverse_cbrt    lane by lane
//   friend scalar lane(register, int) and void set_lane(register&, int, scalar)  for work that has to go lane by lane
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

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

template <class T>
inline constexpr int lane_count = T::kLanes;
template <>
inline constexpr int lane_count<double> = 1;
template <>
inline constexpr int lane_count<float> = 1;

/// Lane `i` in [0, lane_count).
inline double lane(double x, int) { return x; }
inline float lane(float x, int) { return x; }
inline void set_lane(double& x, int, double value) { x = value; }
inline void set_lane(float& x, int, float value) { x = value; }

/// The number that a lane of T holds.
template <class T>
using ScalarOf = decltype(lane(std::declval<T>(), 0));

/// x^n by products, n >= 1: as exact as x is.
template <class T>
T whole_power(T x, int n) {
  for (; n % 2 == 0; n /= 2) x *= x;
  T result = x;
  for (n /= 2; n > 0; n /= 2) {
    x *= x;
    if (n % 2 == 1) result *= x;
  }
  return result;
}

}  // namespace mpm
