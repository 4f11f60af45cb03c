// What a ring about the axis is long on average: its mass is density times the area of its section times this.
// Nairn & Guilkey (2015), after eq. (14), all the way round in place of per radian.
#pragma once

#include <algorithm>

namespace mpm {

constexpr double kTurn = 2.0 * 3.14159265358979323846;

/// 2 pi times the mean radius over a section from r - half to r + half, per its whole width [m]. What of it lies beyond
/// the axis does not count, or, `whole`, counts as the functions count it.
inline double ring_length(double r, double half, bool whole) {
  const double inner = whole ? r - half : std::max(0.0, r - half), outer = r + half;
  return kTurn * (outer * outer - inner * inner) / (4.0 * half);
}

}  // namespace mpm
