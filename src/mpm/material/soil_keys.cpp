// Keys of the laws of soil that have an angle of friction.
#include "mpm/material/law_keys.hpp"

namespace mpm {
namespace {

const KeyTable<SoilSoftening>& softening_keys() {
  using Fall = SoilSoftening;
  static const auto keys =
      KeyTable<Fall>("materials")
          .rows(
              {number("dilation_rise", &Fall::rise, kLength, or_none(kPositive),
                      {"1 mm; `none` where dilation has no limit",
                       "thickness that a shear band gains until dilation ends", "2 mm"}),
               number("softening_slip", &Fall::slip, kLength, or_unset(0.0, kPositive),
                      {"none: the strength stays",
                       "displacement along a shear band over which strength and dilation fall to the critical state",
                       "10 mm"}),
               number("residual_friction_angle", &Fall::friction_angle, kAngle, kNotNegative,
                      {"`friction_angle`", "friction at the end of the fall, at most the peak; needs `softening_slip`",
                       "30 deg"}),
               number("residual_cohesion", &Fall::cohesion, kPressure, kNotNegative,
                      {"`cohesion`", "cohesion at the end of the fall, at most the peak; needs `softening_slip`", "0"}),
               number("shear_band", &Fall::band, kLength, or_unset(0.0, kPositive),
                      {"the longest edge of a cell",
                       "width of a shear band as the grid resolves it, over which `softening_slip` and `dilation_rise` "
                       "are "
                       "spread; not below a cell",
                       "40 mm"})});
  return keys;
}

template <class Law>
KeyTable<Law> soil_keys() {
  return KeyTable<Law>(Law::kName)
      .part(&Law::elasticity, elasticity_keys())
      .rows({number("friction_angle", &Law::friction_angle, kAngle, from_to_below(0.0, 0.5 * kPi),
                    {kRequired, "internal friction", "35 deg"}),
             number("dilation_angle", &Law::dilation_angle, kAngle, kNotNegative,
                    {"", "volume gained in shear; at most `friction_angle`", "5 deg"}),
             number("dilation_limit", &Law::dilation_limit, kPlain, or_none(kPositive),
                    {"0.1; `none` with `softening_slip`, which ends dilation itself",
                     "most volume gained, over the volume at the start, at which dilation ends; the strength stays",
                     "0.05"}),
             number("cohesion", &Law::cohesion, kPressure, kNotNegative, {"", "cohesion", "1 kPa"}),
             number("tension_cutoff", &Law::tension_cutoff, kPressure, or_unset(-1.0, kNotNegative),
                    {"the apex, `cohesion` / tan(`friction_angle`)",
                     "largest mean tension (`drucker_prager`), largest principal tension (`mohr_coulomb`); at most the "
                     "apex",
                     "0"})})
      .part(&Law::softening, softening_keys());
}

}  // namespace

template <>
const KeyTable<DruckerPragerDefinition>& law_keys() {
  using Law = DruckerPragerDefinition;
  static const auto keys =
      soil_keys<Law>().rows({word("match", &Law::match, {"mohr_coulomb", "plane_strain", "compression", "extension"},
                                  {"", "in which states `friction_angle` and `dilation_angle` are those of the soil",
                                   "compression", "mohr_coulomb: friction_angle is that of every state of stress"})});
  return keys;
}

template <>
const KeyTable<MohrCoulombDefinition>& law_keys() {
  static const auto keys = soil_keys<MohrCoulombDefinition>();
  return keys;
}

}  // namespace mpm
