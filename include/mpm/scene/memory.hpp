// How much memory there is, so that a scene that cannot fit is refused and not stopped by the system halfway.
#pragma once

#include "mpm/simulation/definition.hpp"

namespace mpm {

/// Of this machine, or of the container where that has a limit below it [bytes].
double usable_memory();

/// What a run holds of each particle at least, while it sorts [bytes]: what the particle carries, scratch, and its
/// share of the grid's nodes. History, outputs and nodes that few particles share come on top.
double least_bytes_of_particle(const MethodDefinition& method, GeometryKind geometry);

}  // namespace mpm
