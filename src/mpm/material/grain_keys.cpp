// Keys of the laws of grain, sand and clay whose strength follows from a state of their own.
#include "mpm/material/law_keys.hpp"

namespace mpm {

template <>
const KeyTable<MuIDefinition>& law_keys() {
  using Law = MuIDefinition;
  static const auto keys =
      KeyTable<Law>(Law::kName)
          .part(&Law::elasticity, elasticity_keys())
          .rows({number("mu_s", &Law::static_friction, kPlain, kPositive,
                        {kRequired, "friction of slow flow; in plane flow the sine of the friction angle", "0.38"}),
                 number("mu_2", &Law::limiting_friction, kPlain, between(0.0, 1.0),
                        {kRequired, "friction of fast flow, at least `mu_s`", "0.64"}),
                 number("I_0", &Law::reference_inertial, kPlain, kPositive,
                        {"0.279 (glass beads)", "inertial number at which half of the rise is reached", "0.3"}),
                 number("grain_diameter", &Law::grain_diameter, kLength, kPositive,
                        {kRequired, "diameter of the grains", "1 mm"}),
                 number("grain_density", &Law::grain_density, kDensity, kPositive,
                        {"`density` / 0.6", "of the grains themselves, at least `density`", "2650"})});
  return keys;
}

template <>
const KeyTable<CamClayDefinition>& law_keys() {
  using Law = CamClayDefinition;
  static const auto keys =
      KeyTable<Law>(Law::kName)
          .rows({number("lambda", &Law::lambda, kPlain, kPositive,
                        {kRequired, "slope of first compression over ln *p*, above `kappa`", "0.2"}),
                 number("kappa", &Law::kappa, kPlain, kPositive, {kRequired, "slope of swelling over ln *p*", "0.04"}),
                 number("M", &Law::slope, kPlain, between(0.0, 3.0),
                        {kRequired,
                         "slope of the critical state, *q* / *p*; 6 sin φ / (3 - sin φ) for an angle of triaxial "
                         "compression",
                         "0.9"}),
                 number("void_ratio", &Law::void_ratio, kPlain, kPositive,
                        {kRequired, "at the start; *v* = 1 + `void_ratio`", "1.2"}),
                 number("shear_modulus", &Law::shear_modulus, kPressure, or_unset(0.0, kPositive),
                        {"", "constant; elastic strain then gives back the energy that it takes", "2 MPa"}),
                 number("poisson", &Law::poisson, kPlain, between(-1.0, 0.5),
                        {"", "shear modulus in proportion to the bulk modulus, *v* (*p* + `least_pressure`) / `kappa`",
                         "0.3"}),
                 number("preconsolidation_pressure", &Law::consolidation, kPressure, or_unset(0.0, kPositive),
                        {"", "*p*<sub>c</sub> at the start, everywhere", "80 kPa"}),
                 number("overconsolidation_ratio", &Law::overconsolidation, kPlain, or_unset(0.0, at_least(1.0)),
                        {"",
                         "*p*<sub>c</sub> at the start is so many times that of the surface through each particle's "
                         "`initial` stress, `geostatic` too",
                         "1.5"}),
                 number("least_pressure", &Law::least_pressure, kPressure, kPositive,
                        {"a hundredth of `preconsolidation_pressure`; required with a ratio",
                         "below it the clay stiffens no more: clay without pressure has a stiffness, which the classic "
                         "law has not",
                         "500"})})
          .one_of("shear_modulus", "poisson")
          .one_of("preconsolidation_pressure", "overconsolidation_ratio");
  return keys;
}

template <>
const KeyTable<NorSandDefinition>& law_keys() {
  using Law = NorSandDefinition;
  static const auto keys =
      KeyTable<Law>(Law::kName)
          .rows(
              {number("gamma", &Law::gamma, kPlain, kPositive,
                      {kRequired, "void ratio of the critical state at 1 kPa", "0.816"}),
               number("lambda", &Law::lambda, kPlain, kPositive,
                      {kRequired, "its fall over ln *p*, which is that over log<sub>10</sub> *p* by 2.303", "0.0135"}),
               number("critical_exponent", &Law::critical_exponent, kPlain, or_unset(0.0, above_to(0.0, 1.0)),
                      {"none: the logarithm",
                       "*e*<sub>c</sub> = `gamma` - `lambda` (*p* / 100 kPa)<sup>`critical_exponent`</sup> instead, "
                       "which is finite without pressure",
                       "0.7"}),
               number("M", &Law::slope, kPlain, between(0.0, 2.0),
                      {kRequired,
                       "slope of the critical state in triaxial compression, *q* / *p*; 6 sin φ / (3 - sin φ) for an "
                       "angle",
                       "1.26"}),
               number("N", &Law::coupling, kPlain, from_to_below(0.0, 1.0),
                      {kRequired, "part of the dilation that does not raise the strength", "0.35"}),
               number("chi", &Law::dilatancy, kPlain, kPositive,
                      {kRequired, "largest dilation over ψ, 2.5 to 5", "3.5"}),
               number("H", &Law::hardening, kPlain, kPositive,
                      {kRequired, "hardening over plastic shear, 25 to 500; a first estimate is 4 / `lambda`", "103"}),
               number("H_psi", &Law::hardening_of_state, kPlain, kNotNegative,
                      {"", "`H` - `H_psi` ψ is the hardening at the state ψ, at least half of `H`", "980"}),
               number("shear_modulus", &Law::shear_modulus, kPressure, kPositive,
                      {kRequired, "elastic, at 100 kPa", "50 MPa"}),
               number("shear_exponent", &Law::shear_exponent, kPlain, from_to(0.0, 0.9),
                      {"", "its power of the pressure", "0.6", "0.5: G grows with the root of the pressure"}),
               number("poisson", &Law::poisson, kPlain, between(-1.0, 0.4),
                      {"", "elastic", "0.15", "0.2: that of most published constants"}),
               number("void_ratio", &Law::void_ratio, kPlain, kPositive,
                      {"", "at the start; `density` is that of the dry sand then, grains / (1 + `void_ratio`)", "0.7"}),
               other<Law>("relative_density", "number from 0 to 1",
                          {"", "from `e_max`, the loosest void ratio, to `e_min`, the densest", "0.2"}),
               other<Law>("e_max", "number > 0", {"none", "goes with `relative_density`", "0.977"}),
               other<Law>("e_min", "number > 0", {"none", "goes with `relative_density`, below `e_max`", "0.597"}),
               number("overconsolidation_ratio", &Law::overconsolidation, kPlain, at_least(1.0),
                      {"",
                       "the surface at the start is so many times that through each particle's `initial` stress, "
                       "`geostatic` too",
                       "2", "1: the sand has carried no more than its initial stress"}),
               number("least_pressure", &Law::least_pressure, kPressure, kPositive,
                      {"",
                       "is added to the pressure in all but *q* / *p*: sand without pressure has a stiffness, and no "
                       "cohesion. Small beside the pressures that matter",
                       "20", "100 Pa: the weight of some 7 mm of sand"})})
          .one_of("void_ratio", "relative_density");
  return keys;
}

}  // namespace mpm
