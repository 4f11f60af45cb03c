#include "mpm/material/moduli.hpp"

#include <cmath>

#include "mpm/material/law.hpp"

namespace mpm {
namespace {

Moduli moduli(const NewtonianFluidDefinition& law, double) { return {law.bulk_modulus, 0.0}; }
Moduli moduli(const IdealGasDefinition& law, double) {
  return {law.pressure * (law.process == GasProcess::adiabatic ? law.heat_capacity_ratio : 1.0), 0.0};
}
Moduli moduli(const JohnsonCookDefinition& law, double density) {
  return {density * law.pressure.sound_speed * law.pressure.sound_speed, law.shear_modulus};
}
Moduli moduli(const CamClayDefinition& law, double) {
  const double bulk = (1.0 + law.void_ratio) * law.least_pressure / law.kappa;
  return {bulk, law.shear_modulus > 0.0 ? law.shear_modulus : law.shear_over_bulk() * bulk};
}
Moduli moduli(const NorSandDefinition& law, double) {
  const double shear = law.shear_modulus * std::pow(law.least_pressure / 1e5, law.shear_exponent);
  return {shear / law.shear_over_bulk(), shear};
}
// A wave's front is faster than relaxation.
Moduli moduli(const StandardLinearSolidDefinition& law, double) {
  return {law.elasticity.bulk(), law.elasticity.shear() + law.branch_modulus};
}
template <class Definition>
Moduli moduli(const Definition& law, double) {
  return {law.elasticity.bulk(), law.elasticity.shear()};
}

}  // namespace

Moduli moduli_of(const MaterialDefinition& material) {
  return std::visit([&](const auto& law) { return moduli(law, material.density); }, material.law);
}

double constant_bulk_modulus(const MaterialDefinition& material) {
  const LawTraits traits = traits_of(material);
  return traits.stiffness_of_pressure || traits.own_temperature ? 0.0 : moduli_of(material).bulk;
}

}  // namespace mpm
