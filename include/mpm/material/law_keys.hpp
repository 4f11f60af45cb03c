// The keys of materials and of their laws as tables, and what has to hold between the constants of a law.
#pragma once

#include <optional>

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
/// Keys of Young's modulus and Poisson's ratio, which most laws have.
const KeyTable<Elasticity>& elasticity_keys();

/// The first constant that is out of its range, or does not fit the others.
std::optional<KeyFault> material_fault(const MaterialDefinition& material);

}  // namespace mpm
