// Moduli of a material as a run starts, for small deformations of the undeformed material without pressure.
#pragma once

#include "mpm/material/definition.hpp"

namespace mpm {

struct Moduli {
  double bulk, shear;  ///< [Pa]
};
Moduli moduli_of(const MaterialDefinition& material);

/// Bulk modulus of a law that has a constant one [Pa], else 0: stiffness that follows the pressure, a law with a
/// temperature of its own.
double constant_bulk_modulus(const MaterialDefinition& material);

}  // namespace mpm
