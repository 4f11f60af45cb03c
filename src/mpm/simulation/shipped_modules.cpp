#include "shipped_modules.hpp"

namespace mpm {

const std::vector<ShippedModules>& shipped_modules() {
  static const std::vector<ShippedModules> kList = {
      {add_stress_average},
      {add_periodic},
      {add_leaving},
      {add_axis},
      {add_damping, {{"alpha", "1/s"}}},
      {add_transport,  // before contact, which tells it of heat
       {{"temperature content", "J"}, {"concentration content", "m^3"}, {"pore_pressure content", "m^3"}}},
      {add_rigid_motion},
      {add_tool_sides},  // before contact, which asks it
      {add_absorbing},
      {add_walls},
      {add_conditions},
      {add_pairs},
      {add_rigid_contact},
      {add_particle_loads},
      {add_tractions},
      {add_sleep, {{"asleep", "1"}}},
      {add_step_limit},
  };
  return kList;
}

}  // namespace mpm
