// Definition of the growth of cracks in a scene: criteria, directions and the constants of materials. J and G in J/m^2,
// K in Pa sqrt(m), openings in m.
// Source: NairnMPM's manual, Propagate, AltPropagate, PropagateLength.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace mpm {

/// In the order of the manual's numbers.
enum class FractureCriterion {
  none,
  hoop_stress,     ///< 1, "maximum energy release": K_I and K_II by the stress across the kink
  steady_state,    ///< 2: at a speed that is given
  energy_balance,  ///< 3: the speed follows from the energies
  energy_density,  ///< 4: minimum of the strain energy density
  elliptical,      ///< 5: an ellipse of K_I and K_II
  opening,         ///< 6: crack tip opening displacement
  release_rate     ///< 7: J
};
inline constexpr std::array<const char*, 8> kFractureCriterionNames = {
    "none", "hoop_stress", "steady_state", "energy_balance", "energy_density", "elliptical", "opening", "release_rate"};

/// In the order of the manual's numbers.
enum class GrowthDirection {
  by_criterion,
  self_similar,       ///< along the last segment
  normal_to_opening,  ///< normal to the opening of the faces behind the tip
  hoop_of_opening,    ///< the hoop angle with openings in place of K_I and K_II
  initial             ///< that of the tip at the start
};
inline constexpr std::array<const char*, 5> kGrowthDirectionNames = {"by_criterion", "self_similar",
                                                                     "normal_to_opening", "hoop_of_opening", "initial"};

/// One rule of growth, the first or the alternate one.
struct GrowthRule {
  FractureCriterion criterion = FractureCriterion::none;
  GrowthDirection direction = GrowthDirection::by_criterion;
  std::string traction;  ///< name of the law that new faces have; empty: none
};

/// A material's constants of fracture. What is 0 is not known.
struct FractureConstants {
  std::optional<GrowthRule> growth, alternate;   ///< in place of the scene's own
  double k_ic = 0.0, k_iic = 0.0;                ///< toughness [Pa sqrt(m)]
  double k_exponent = 2.0, k_ii_exponent = 2.0;  ///< p and q of criterion `elliptical`
  double j_ic = 0.0;                             ///< [J/m^2]
  double opening_ic = 0.0, opening_iic = 0.0;    ///< [m]
  double speed = 0.0;                   ///< speed of steady growth [m/s]; energy balance: part of the wave speed
  double start_time = -1.0;             ///< start of steady growth [s]; negative: it starts by j_ic
  double longest = 0.0;                 ///< length at which steady growth ends [m]; 0: never
  std::array<double, 2> way{0.0, 0.0};  ///< direction of steady growth, along the plane's axes; (0, 0): self-similar
  double surface_energy = 0.0;          ///< gamma of the energy balance [J/m^2]; 0: j_ic / 2
  double plastic_part = 1.0;            ///< p of the energy balance
  double gain = 0.1;                    ///< gain of its speed [(m/s)/(J/m^2)]; 1e5 (mm/s)/(N/mm)
  bool keeps_tips = false;              ///< a tip in this material stays one of it ("constantTip")

  bool known() const {
    return growth || k_ic > 0.0 || j_ic > 0.0 || opening_ic > 0.0 || opening_iic > 0.0 || speed > 0.0;
  }
};

}  // namespace mpm
