// Numbers that have a name everywhere.
#pragma once

#include <limits>

namespace mpm {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTurn = 2.0 * kPi;      ///< [rad]
inline constexpr double kDegree = kPi / 180.0;  ///< [rad]
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace mpm
