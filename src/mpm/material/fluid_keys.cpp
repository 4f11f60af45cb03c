// Keys of the laws of liquids and gases.
#include "mpm/material/law_keys.hpp"

namespace mpm {

template <>
const KeyTable<NewtonianFluidDefinition>& law_keys() {
  using Law = NewtonianFluidDefinition;
  static const auto keys =
      KeyTable<Law>(Law::kName)
          .rows({number("bulk_modulus", &Law::bulk_modulus, kPressure, kPositive,
                        {"", "K, at the material's density", "2.2 GPa"}),
                 other<Law>("sound_speed", "velocity > 0", {"", "K = density × its square", "20 m/s"}),
                 number("exponent", &Law::exponent, kPlain, at_least(1.0), {"", "n; 1 is a linear fluid", "7"}),
                 number("viscosity", &Law::viscosity, kViscosity, kNotNegative, {"", "dynamic viscosity", "1e-3 Pa s"}),
                 word("tension", &Law::tension, {"none", "allow"},
                      {"",
                       "whether pressure may be negative; with `none`, a free surface parts freely and must close "
                       "again before it carries pressure",
                       "allow", "none: a free surface parts without resistance"})})
          .one_of("bulk_modulus", "sound_speed");
  return keys;
}

template <>
const KeyTable<IdealGasDefinition>& law_keys() {
  using Law = IdealGasDefinition;
  static const auto keys =
      KeyTable<Law>(Law::kName)
          .rows(
              {number("pressure", &Law::pressure, kPressure, kPositive,
                      {kRequired, "p₀, absolute, at `density` and `temperature`", "101325 Pa"}),
               number("temperature", &Law::temperature, kTemperature, kPositive, {kRequired, "T₀, absolute", "293 K"}),
               number("ambient_pressure", &Law::ambient, kPressure, kNotNegative,
                      {"",
                       "acts from outside and is not modelled: stress and forces on tools are relative to it; a gas at "
                       "its "
                       "ambient pressure stays where it is",
                       "1.013 bar"}),
               number(
                   "heat_capacity_ratio", &Law::heat_capacity_ratio, kPlain, above(1.0),
                   {"", "of constant pressure to constant volume; without effect when isothermal", "1.67", "1.4: air"}),
               word("process", &Law::process, {"adiabatic", "isothermal"},
                    {"", "whether the gas warms as it is compressed", "isothermal",
                     "adiabatic: no heat leaves the gas"})});
  return keys;
}

}  // namespace mpm
