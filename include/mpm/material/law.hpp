// The closed list of constitutive laws, and the functions that the mechanics calls. A law is a plain class, derived
// from LawTraits (increment.hpp) for the constants and functions that it does not define itself, with
//
//   void update(increment, tau, history) const;      tau: Kirchhoff stress over initial density [J/kg], in and out;
//                                                    history[k]: in and out; k < kHistory <= mpm_kernel::kMostHistory
//   double elastic_energy(F, tau, J) const;          [J/kg]
//   T wave_speed(F, tau, J) const;                   [m/s], of the fastest small wave on the present state (tangent)
//   double density() const;                          [kg/m^3], initial
//
// The law is chosen once per block and body (kernel/stress.hpp); inside there is no virtual call and no branch on it.
// update(), wave_speed() and diffusivity() are templates, written once for a number and for a wide register of
// particles (math/lanes.hpp): instead of branching on a value they select, and skip work that no lane needs. The rest
// is for single numbers. To add a law: a definition in definition.hpp, a file beside these, its name in the two
// variants and in make_law().
#pragma once

#include <variant>

#include "mpm/material/cam_clay.hpp"
#include "mpm/material/definition.hpp"
#include "mpm/material/drucker_prager.hpp"
#include "mpm/material/ideal_gas.hpp"
#include "mpm/material/j2_plasticity.hpp"
#include "mpm/material/johnson_cook.hpp"
#include "mpm/material/linear_elastic.hpp"
#include "mpm/material/mohr_coulomb.hpp"
#include "mpm/material/mu_i.hpp"
#include "mpm/material/neo_hookean.hpp"
#include "mpm/material/newtonian_fluid.hpp"
#include "mpm/material/norsand.hpp"
#include "mpm/material/standard_linear_solid.hpp"

namespace mpm {

using Law = std::variant<LinearElastic, NeoHookean, DruckerPrager, MohrCoulomb, J2Plasticity, NewtonianFluid, IdealGas,
                         StandardLinearSolid, JohnsonCook, MuI, CamClay, NorSand>;

/// Makes the law of a material. @throws MaterialError as check() does
Law make_law(const MaterialDefinition& material);

inline int history_size(const Law& law) {
  return std::visit([](const auto& l) { return l.kHistory; }, law);
}

}  // namespace mpm
