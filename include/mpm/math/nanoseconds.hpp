// Simulated time in whole nanoseconds, as sync points have it, and in seconds, as equations do.
#pragma once

#include <cmath>
#include <cstdint>

namespace mpm {

inline constexpr double kNanosecond = 1e-9;          ///< [s]
inline constexpr double kNanosecondsOfSecond = 1e9;  ///< [ns]

/// Seconds of `nanoseconds`, as the solver computes with them: within two roundings.
constexpr double seconds_of(std::int64_t nanoseconds) { return static_cast<double>(nanoseconds) * kNanosecond; }

/// The number of seconds nearest to `nanoseconds`, which is what a reader of its decimals gets.
constexpr double nearest_seconds(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) / kNanosecondsOfSecond;
}

/// The whole number of nanoseconds nearest to `seconds`.
inline std::int64_t nanoseconds_of(double seconds) { return std::llround(seconds * kNanosecondsOfSecond); }

}  // namespace mpm
