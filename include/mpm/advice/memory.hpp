// The memory of the machine and the least memory of a run, so that a scene that cannot fit is refused instead of being
// stopped by the system halfway.
#pragma once

#include "mpm/definition/definition.hpp"

namespace mpm {

/// Memory of this machine, or of the container or this process if their limits are lower [bytes].
double usable_memory();

/// Least memory per particle while particles are sorted [bytes]: the particle's data, scratch, and its share of the
/// grid's nodes. History, outputs and nodes shared by few particles come on top.
double least_bytes_of_particle(const MethodDefinition& method, GeometryKind geometry);

}  // namespace mpm
