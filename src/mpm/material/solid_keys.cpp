// Keys of the laws of solids and metals.
#include "mpm/material/law_keys.hpp"

namespace mpm {
namespace {

const KeyTable<MieGrueneisenDefinition>& shock_keys() {
  using Shock = MieGrueneisenDefinition;
  static const auto keys =
      KeyTable<Shock>("materials")
          .rows({number("C0", &Shock::sound_speed, kVelocity, kPositive,
                        {kRequired, "a shock runs at C0 + S u, where u is the speed behind it", "3574 m/s"}),
                 number("S", &Shock::hugoniot_slope, kPlain, kNotNegative, {kRequired, "see `C0`", "1.92"}),
                 number("gamma0", &Shock::gamma0, kPlain, kPositive, {kRequired, "Grueneisen's constant γ₀", "1.69"})});
  return keys;
}

}  // namespace

const KeyTable<MaterialDefinition>& material_keys() {
  static const auto keys =
      KeyTable<MaterialDefinition>("materials")
          .rows({other<MaterialDefinition>("name", "name", {kRequired, "name by which bodies refer to it", "sand"}),
                 number("density", &MaterialDefinition::density, kDensity, kPositive,
                        {kRequired, "density before deformation", "1600"}),
                 other<MaterialDefinition>("law", "word", {kRequired, "one of the laws below", "neo_hookean"})});
  return keys;
}

const KeyTable<Elasticity>& elasticity_keys() {
  static const auto keys =
      KeyTable<Elasticity>("materials")
          .rows({number("young", &Elasticity::young, kPressure, kPositive, {kRequired, "Young's modulus", "1 MPa"}),
                 number("poisson", &Elasticity::poisson, kPlain, between(-1.0, 0.5),
                        {kRequired, "Poisson's ratio", "0.3"})});
  return keys;
}

template <>
const KeyTable<LinearElasticDefinition>& law_keys() {
  using Law = LinearElasticDefinition;
  static const auto keys = KeyTable<Law>(Law::kName).part(&Law::elasticity, elasticity_keys());
  return keys;
}

template <>
const KeyTable<NeoHookeanDefinition>& law_keys() {
  using Law = NeoHookeanDefinition;
  static const auto keys = KeyTable<Law>(Law::kName).part(&Law::elasticity, elasticity_keys());
  return keys;
}

template <>
const KeyTable<StandardLinearSolidDefinition>& law_keys() {
  using Law = StandardLinearSolidDefinition;
  static const auto keys =
      KeyTable<Law>(Law::kName)
          .part(&Law::elasticity, elasticity_keys())
          .rows({number(
                     "branch_modulus", &Law::branch_modulus, kPressure, kPositive,
                     {kRequired, "shear modulus of the spring, which fast motion adds to the long-term one", "10 kPa"}),
                 number("relaxation_time", &Law::relaxation_time, kTime, kPositive,
                        {kRequired, "time in which the branch's stress falls to 1/e", "50 ms"})});
  return keys;
}

template <>
const KeyTable<J2PlasticityDefinition>& law_keys() {
  using Law = J2PlasticityDefinition;
  static const auto keys =
      KeyTable<Law>(Law::kName)
          .part(&Law::elasticity, elasticity_keys())
          .rows({number("yield_stress", &Law::yield_stress, kPressure, kPositive,
                        {kRequired, "Mises stress at first yield", "250 MPa"}),
                 number("hardening_modulus", &Law::hardening_modulus, kPressure, kNotNegative,
                        {"", "linear part of the hardening", "1 GPa"}),
                 number("saturation_stress", &Law::saturation_stress, kPressure, or_unset(0.0, kPositive),
                        {"", "at least `yield_stress`; of Voce's part", "400 MPa"}),
                 number("saturation_rate", &Law::saturation_rate, kPlain, or_unset(0.0, kPositive),
                        {"", "per unit of plastic strain", "15"})})
          .together("saturation_stress", "saturation_rate");
  return keys;
}

template <>
const KeyTable<JohnsonCookDefinition>& law_keys() {
  using Law = JohnsonCookDefinition;
  static const auto keys =
      KeyTable<Law>(Law::kName)
          .rows({number("shear_modulus", &Law::shear_modulus, kPressure, kPositive, {kRequired, "G", "77.3 GPa"})})
          .part(&Law::pressure, shock_keys())
          .rows(
              {number("A", &Law::yield_stress, kPressure, kPositive, {kRequired, "strength at first yield", "1.5 GPa"}),
               number("B", &Law::hardening, kPressure, kNotNegative, {"", "hardening", "569 MPa"}),
               number("n", &Law::hardening_exponent, kPlain, above_to(0.0, 1.0),
                      {"", "power of the plastic strain in the hardening", "0.22"}),
               number("C", &Law::rate_sensitivity, kPlain, kNotNegative, {"", "strengthening by rate", "0.003"}),
               number("reference_rate", &Law::reference_rate, kRate, kPositive,
                      {"", "slower flow has the strength of this rate", "1 1/s"}),
               number("m", &Law::softening_exponent, kPlain, kPositive,
                      {"", "softening by heat, to zero strength at melting", "1.17"}),
               number("melting_temperature", &Law::melting_temperature, kTemperature, or_unset(0.0, kPositive),
                      {"", "above `reference_temperature`", "1777 K",
                       "none: heat neither softens nor melts the material"}),
               number("reference_temperature", &Law::reference_temperature, kTemperature, kPositive,
                      {"", "that of A, and of bodies without `initial: {temperature}`", "300 K",
                       "293 K: the strength's A is of a room"}),
               number("heat_capacity", &Law::heat_capacity, kHeatCapacity, kPositive,
                      {kRequired, "at constant volume", "477 J/(kg K)"}),
               number("heat_fraction", &Law::heat_fraction, kPlain, kPart,
                      {"", "part of the plastic work that becomes heat", "1"})})
          .together("B", "n")
          .together("m", "melting_temperature");
  return keys;
}

}  // namespace mpm
