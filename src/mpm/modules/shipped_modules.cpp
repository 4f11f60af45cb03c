#include "mpm/modules/shipped_modules.hpp"

#include "mpm/crack/crack_stage.hpp"
#include "mpm/transport/transport.hpp"

namespace mpm {
namespace {

constexpr int kNumbered = 9;  ///< cracks whose numbers are global quantities

std::vector<std::pair<std::string, std::string>> numbers_of_cracks() {
  std::vector<std::pair<std::string, std::string>> list;
  for (int number = 1; number <= kNumbered; ++number) {
    const auto own = crack_numbers(number);
    list.insert(list.end(), own.begin(), own.end());
  }
  return list;
}

}  // namespace

const std::vector<ShippedModules>& shipped_modules() {
  static const std::vector<ShippedModules> kList = {
      {add_stress_average},
      {add_volume_correction},
      {add_periodic},
      {add_leaving},
      {add_axis},
      {add_damping, {{"alpha", "1/s"}}},
      {add_transport, transport_numbers()},  // before contact, which tells it of heat
      {add_rigid_motion},
      {add_robots},
      {add_tool_sides},  // before contact, which asks it
      {add_absorbing},
      {add_walls},
      {add_conditions},
      {add_pairs},
      {add_rigid_contact},
      {add_implicit,
       {{"sweeps", "1"},
        {"sweep_change", "1"},
        {"sweep_modulus", "Pa"},
        {"sweep_load", "1"},
        {"sweeps_cut", "1"},
        {"sweep_error", "1"}}},
      {add_particle_loads},
      {add_tractions},
      {add_cracks, numbers_of_cracks()},
      {add_sleep, {{"asleep", "1"}}},
      {add_bed,
       {{"ground_made", "kg"}, {"ground_put_away", "kg"}, {"ground_kept", "kg"}}},  // after sleep, which it asks
      {add_volumes},
      {add_step_limit},
  };
  return kList;
}

}  // namespace mpm
