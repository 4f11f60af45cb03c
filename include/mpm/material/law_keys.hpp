// The keys of materials and of their laws as tables, and what has to hold between the constants of a law.
#pragma once

#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "mpm/keys/key_table.hpp"
#include "mpm/material/definition.hpp"

namespace mpm {

/// Keys of each material, whatever its law.
const KeyTable<MaterialDefinition>& material_keys();
/// Keys of a law.
template <class Law>
const KeyTable<Law>& law_keys();
template <>
const KeyTable<LinearElasticDefinition>& law_keys();
template <>
const KeyTable<NeoHookeanDefinition>& law_keys();
template <>
const KeyTable<DruckerPragerDefinition>& law_keys();
template <>
const KeyTable<MohrCoulombDefinition>& law_keys();
template <>
const KeyTable<J2PlasticityDefinition>& law_keys();
template <>
const KeyTable<NewtonianFluidDefinition>& law_keys();
template <>
const KeyTable<IdealGasDefinition>& law_keys();
template <>
const KeyTable<StandardLinearSolidDefinition>& law_keys();
template <>
const KeyTable<JohnsonCookDefinition>& law_keys();
template <>
const KeyTable<MuIDefinition>& law_keys();
template <>
const KeyTable<CamClayDefinition>& law_keys();
template <>
const KeyTable<NorSandDefinition>& law_keys();
/// Calls visit(law) with a definition of each law of the list, without that of laws that programs add.
template <class Visit, class... Laws>
void each_law_of(const std::variant<Laws...>*, Visit&& visit) {
  const auto each = [&](const auto& law) {
    if constexpr (!std::is_same_v<std::decay_t<decltype(law)>, UserLawDefinition>) visit(law);
  };
  (each(Laws()), ...);
}
template <class Visit>
void each_law(Visit&& visit) {
  each_law_of(static_cast<const LawDefinition*>(nullptr), std::forward<Visit>(visit));
}
/// Keys of Young's modulus and Poisson's ratio, which most laws have.
const KeyTable<Elasticity>& elasticity_keys();

/// The first constant that is out of its range, or does not fit the others.
std::optional<KeyFault> material_fault(const MaterialDefinition& material);

}  // namespace mpm
