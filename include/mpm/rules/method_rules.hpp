// The rules on which parts of a method go together, in one place. They are checked when a scene's section is read and
// when a Simulation is put together, so they hold for definitions made by hand too.
#pragma once

#include <optional>
#include <string>

#include "mpm/definition/definition.hpp"
#include "mpm/keys/key_table.hpp"
#include "mpm/material/law.hpp"

namespace mpm {

/// Reason why a method is impossible, and what can be used instead. Its key is one of the scene's section `method` that
/// has to change: "transfer", "damping.placement".
using MethodFault = KeyFault;

/// The first rule that a method breaks; empty when it breaks none.
std::optional<MethodFault> method_fault(const MethodDefinition& method, GeometryKind geometry);

/// The largest time.cfl that a transfer is known to be stable with; 1 where it does not lower the limit. Source:
/// doc/methods.md, the time step.
double stable_cfl(const Transfer& transfer);

/// True if what flows has one stress in a cell. If the method does not say so: wherever it can lock, unless another
/// remedy, average_dilatation, is chosen.
bool averages_stress(const MethodDefinition& method, GeometryKind geometry);
/// True if the balance of energy of scenes of a law was measured, and closes to 1 %: soil whose stiffness is its own.
/// No elastic energy is known that closed paths leave as it was where stiffness follows the pressure (2.8 % of the
/// energy spent under a plate on cam_clay that moves up and down).
bool closes_energy(const LawTraits& traits);
/// True if particles of a body can share their stress: its law can, and if it finds the pressure from J, neither heat
/// nor moisture strains the material, since that pressure belongs to what is left of J without such a strain.
bool shares_stress(const SimulationDefinition& definition, const DeformableBody& body);

}  // namespace mpm
