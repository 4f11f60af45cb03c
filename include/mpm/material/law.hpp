// The closed list of constitutive laws, and the functions that the mechanics calls. A law is a plain class, derived
// from LawDefaults (increment.hpp) for the constants and functions that it does not define itself, with
//
//   constants kMatter … kImplicit                    what it is (LawTraits in increment.hpp); all of them
//   void update(increment, tau, history) const;      tau: Kirchhoff stress over initial density [J/kg], in and out;
//                                                    history[k]: in and out; k < kHistory <= mpm_kernel::kMostHistory
//   double elastic_energy(F, tau, J) const;          [J/kg]
//   T wave_speed(F, tau, J) const;                   [m/s], of the fastest small wave on the present state (tangent)
//   double density() const;                          [kg/m^3], initial
//
// The law is chosen once per block and body (kernel/stress.hpp); inside there is no virtual call and no branch on it.
// update(), wave_speed() and diffusivity() are templates, written once for a number and for a wide register of
// particles (math/lanes.hpp): instead of branching on a value they select, and skip work that no lane needs. The rest
// is for single numbers. To add a law: a definition and its name in the list in definition.hpp, its keys in
// law_keys.hpp, what holds between its constants in material_fault.cpp, a file beside these, and its header below.
// Others ask what it is by its traits, not by its name.
#pragma once

#include <string>
#include <type_traits>
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
#include "mpm/material/user_law.hpp"

namespace mpm {

template <class Definitions>
struct LawsOf;
template <class... Definition>
struct LawsOf<std::variant<Definition...>> {
  using type = std::variant<typename Definition::Law...>;
};
using Law = LawsOf<LawDefinition>::type;

template <class OneLaw>
LawTraits traits_of(const OneLaw&) {
  return kTraitsOf<OneLaw>;
}
LawTraits traits_of(const UserLaw& law);
inline LawTraits traits_of(const Law& law) {
  return std::visit([](const auto& own) { return traits_of(own); }, law);
}
LawTraits traits_of(const LawDefinition& law);
inline LawTraits traits_of(const MaterialDefinition& material) { return traits_of(material.law); }

/// True if one of the list, not one of a user's, has this name.
bool listed_law(const std::string& name);
/// Names of the laws whose traits fit, those of users last, as "a, b and c".
std::string law_names(bool (*fits)(const LawTraits&));

/// Makes the law of a material. @throws MaterialError as check() does
Law make_law(const MaterialDefinition& material);

inline int history_size(const Law& law) {
  return std::visit([](const auto& l) { return l.kHistory; }, law);
}

}  // namespace mpm
