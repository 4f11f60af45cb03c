// From the precision of a run's particles to a type.
#pragma once

#include "mpm/particles/particle_scalar.hpp"

namespace mpm {

/// visit(0.0F) or visit(0.0), whose type is that of the particles' numbers.
template <class Visit>
decltype(auto) with_precision(Precision precision, Visit&& visit) {
  return precision == Precision::float32 ? visit(0.0F) : visit(0.0);
}

}  // namespace mpm
