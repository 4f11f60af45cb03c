// Soil that has opened remembers by how much, and must close again before it carries pressure; otherwise every opening
// would turn into spurious stress on the way back. Shared by the laws of soil.
#pragma once

#include <algorithm>

namespace mpm {

/// Closes what pressure there is room for. `mean`: trial mean stress, tension positive [Pa]; `opening`: logarithmic
/// volume, >= 0, reduced by what closes. Gives what is left of the mean stress.
template <class T>
T close_opening(T mean, T bulk, T& opening) {
  if (!(opening > T(0) && mean < T(0))) return mean;
  const T closing = std::min(opening, -mean / bulk);
  opening -= closing;
  return mean + bulk * closing;
}

}  // namespace mpm
