// Numbers of a crack's tip, each described once: where it stands, its name in checkpoints, and its name and unit among
// the numbers of a run. The run's state, what a scene may ask for and the solver's report go through the table, so a
// member and a row are all that a new number asks of the solver; its message is a row of quantities.cpp.
#pragma once

#include "mpm/crack/stress_intensity.hpp"

namespace mpm {

/// As the tip was last looked at.
struct TipNumbers {
  double j = 0.0;                    ///< at the tip, without work of tractions behind it [J/m^2]
  double zone = 0.0;                 ///< that work, by area [J/m^2]
  StressIntensity k;                 ///< 0 where the material has none
  double opening = 0.0, slip = 0.0;  ///< opening and slip of the faces next to the tip [m]
  double grown = 0.0;                ///< by so much since the start [m]
  double speed = 0.0;                ///< speed of the last growth: its length over the time since [m/s]
  double running = 0.0;              ///< at a speed that its criterion sets, now [m/s]
  double angle = 0.0;                ///< angle of the last growth from the direction before it [rad]
  double first_angle = 0.0;          ///< angle of the first growth [rad]
  double released = 0.0;             ///< J at the last growth, with the zone [J/m^2]
  double energy_release = 0.0;       ///< by the balance of energy, in its last growths [J/m^2]
  double last_growth = 0.0;          ///< time of it [s]
  double next_look = 0.0;            ///< at growth, not before [s]
  int growths = 0;
  bool by_alternate = false;  ///< the last growth was by the alternate rule
};

struct TipNumber {
  const char* stored;  ///< name in checkpoints
  const char* name;    ///< in "crack 1 end j" of a run's numbers; null: it is not among them
  const char* unit;
  double& (*at)(TipNumbers&);
  const double& (*of)(const TipNumbers&);

  /// `member`: gives the member of tips that may change and that may not.
  template <class Member>
  constexpr TipNumber(const char* in_checkpoints, const char* in_runs, const char* unit, Member member)
      : stored(in_checkpoints), name(in_runs), unit(unit), at(member), of(member) {}
};

#define MPM_TIP_NUMBER(stored, name, unit, path) \
  TipNumber(                                     \
      stored, name, unit, [](auto& tip) -> auto& { return tip.path; })
inline constexpr TipNumber kTipNumbers[] = {
    MPM_TIP_NUMBER("j", "j", "J/m^2", j),
    MPM_TIP_NUMBER("zone", nullptr, "J/m^2", zone),
    MPM_TIP_NUMBER("k_one", "k_one", "Pa m^0.5", k.one),
    MPM_TIP_NUMBER("k_two", "k_two", "Pa m^0.5", k.two),
    MPM_TIP_NUMBER("first_angle", "kink_angle", "rad", first_angle),
    MPM_TIP_NUMBER("grown", "growth", "m", grown),
    MPM_TIP_NUMBER("speed", "speed", "m/s", speed),
    MPM_TIP_NUMBER("opening_normal", "opening", "m", opening),
    MPM_TIP_NUMBER("opening_shear", nullptr, "m", slip),
    MPM_TIP_NUMBER("angle", nullptr, "rad", angle),
    MPM_TIP_NUMBER("running", nullptr, "m/s", running),
    MPM_TIP_NUMBER("released", nullptr, "J/m^2", released),
    MPM_TIP_NUMBER("energy_release", "energy_release", "J/m^2", energy_release),
    MPM_TIP_NUMBER("last_growth", nullptr, "s", last_growth),
    MPM_TIP_NUMBER("next_look", nullptr, "s", next_look),
};
#undef MPM_TIP_NUMBER

}  // namespace mpm
