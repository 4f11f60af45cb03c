// The mean length of a ring about the axis: the mass of a ring is density times area of its section times this length.
// Source: Nairn & Guilkey (2015), after eq. (14); for the whole turn instead of per radian.
#pragma once

#include <algorithm>

#include "mpm/math/constants.hpp"

namespace mpm {

/// The integral of 2 pi r over a section from r - half to r + half, divided by the section's whole width [m]. The part
/// beyond the axis does not count, or, with `whole`, counts with its negative radius, as in the shape functions.
inline double ring_length(double r, double half, bool whole) {
  const double inner = whole ? r - half : std::max(0.0, r - half), outer = r + half;
  return kTurn * (outer * outer - inner * inner) / (4.0 * half);
}

}  // namespace mpm
