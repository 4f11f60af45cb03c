// The closed list of constitutive laws, and what the mechanics asks of each. A law is a plain class, derived from
// LawTraits (increment.hpp) for the constants and functions that it does not define itself, with
//
//   void update(increment, tau, history) const;      tau: Kirchhoff stress over initial density [J/kg], in and out;
//                                                    history[k]: in and out; k < kHistory <= mpm_kernel::kMostHistory
//   double elastic_energy(F, tau, J) const;          [J/kg]
//   T wave_speed(F, tau, J) const;                   [m/s], of the fastest small wave on the present state (tangent)
//   double density() const;                          [kg/m^3], initial
//
// It is chosen once a block's particles of one body (kernel/stress.hpp); inside, no virtual call and no branch on it.
// update(), wave_speed() and diffusivity() are templates, written once for a number and for a wide register of as many
// particles (math/lanes.hpp): no branch on a value, but selections and work that is skipped where no lane needs it. The
// rest is for numbers alone.
// To add one: a definition in definition.hpp, a file beside these, its name in the two variants and in make_law().
#pragma once

#include <variant>

#include "mpm/material/definition.hpp"
#include "mpm/material/drucker_prager.hpp"
#include "mpm/material/ideal_gas.hpp"
#include "mpm/material/j2_plasticity.hpp"
#include "mpm/material/johnson_cook.hpp"
#include "mpm/material/linear_elastic.hpp"
#include "mpm/material/mohr_coulomb.hpp"
#include "mpm/material/neo_hookean.hpp"
#include "mpm/material/newtonian_fluid.hpp"
#include "mpm/material/standard_linear_solid.hpp"

namespace mpm {

using Law = std::variant<LinearElastic, NeoHookean, DruckerPrager, MohrCoulomb, J2Plasticity, NewtonianFluid, IdealGas,
                         StandardLinearSolid, JohnsonCook>;

/// @throws MaterialError when check() does.
Law make_law(const MaterialDefinition& material);

inline int history_size(const Law& law) {
  return std::visit([](const auto& l) { return l.kHistory; }, law);
}

}  // namespace mpm
