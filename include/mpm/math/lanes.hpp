// Arithmetic that is written once for a number and for a wide register of numbers (kernel/wide.hpp). A branch on a
// value becomes a select() between two results, or an any() that skips work which no lane needs.
//
// Call the functions below without std::, so that those of a register type are found by argument-dependent lookup.
// Masks, the results of comparisons, are combined with & | ! only, which also work for bool. A register type has the
// operators of a number, a default constructor, a constructor T(x) from a double, and
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

/// a where `which` holds, b elsewhere. Both are computed.
template <class T>
T select(bool which, T a, T b) {
  return which ? a : b;
}
/// True if `which` holds in any lane.
inline bool any(bool which) { return which; }
/// True if `which` holds in every lane.
inline bool all(bool which) { return which; }

template <class T>
inline constexpr int lane_count = T::kLanes;
template <>
inline constexpr int lane_count<double> = 1;
template <>
inline constexpr int lane_count<float> = 1;

/// The number in lane `i`, 0 <= i < lane_count.
inline double lane(double x, int) { return x; }
inline float lane(float x, int) { return x; }
inline void set_lane(double& x, int, double value) { x = value; }
inline void set_lane(float& x, int, float value) { x = value; }

/// The type of the number in a lane of T.
template <class T>
using ScalarOf = decltype(lane(std::declval<T>(), 0));

/// x^n, n >= 1, by repeated multiplication.
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
