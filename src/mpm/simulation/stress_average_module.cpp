// Mean stresses of cells as a module, for the bodies whose law flows without a change of volume of its own choosing.
#include <fmt/format.h>

#include <algorithm>

#include "mpm/mechanics/stress_average.hpp"
#include "mpm/simulation/method_rules.hpp"
#include "mpm/simulation/simulation.hpp"
#include "shipped_modules.hpp"

namespace mpm {
namespace {

/// Whether heat, moisture or water strains this material freely.
bool expands(const SimulationDefinition& definition, std::size_t material) {
  const auto& quantities = definition.transport.quantities;
  return std::any_of(quantities.begin(), quantities.end(), [&](const QuantityDefinition& quantity) {
    return material < quantity.materials.size() && quantity.materials[material].expansion != 0.0;
  });
}

}  // namespace

void add_stress_average(RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  if (!averages_stress(definition.method, definition.geometry, definition.cracks.any())) return;
  std::vector<AveragedSet> sets;
  for (std::size_t s = 0; s < parts.sets.size(); ++s) {
    const std::string& name = definition.bodies[s].material;
    const auto material = std::find_if(definition.materials.begin(), definition.materials.end(),
                                       [&](const MaterialDefinition& one) { return one.name == name; });
    if (!has_averaged_stress(parts.laws[s])) continue;
    // Stress that is found from J would have to be found from what is left of it without the free strain.
    if (expands(definition, material - definition.materials.begin()) && finds_pressure_from_volume(parts.laws[s])) {
      if (!definition.method.average_stress) continue;
      throw DefinitionError(fmt::format(
          "method.average_stress: '{}' expands with heat or moisture, and its pressure follows from its volume; its "
          "particles cannot share a stress: leave the key out, and bodies of this material are passed over",
          name));
    }
    sets.push_back({&parts.sets[s], &parts.laws[s]});
  }
  if (sets.empty()) {
    if (!definition.method.average_stress) return;
    throw DefinitionError(
        "method.average_stress: no body is of drucker_prager, mohr_coulomb, mu_i or j2_plasticity, whose stresses it "
        "averages; leave it out");
  }
  parts.modules.add(std::make_unique<StressAverage>(std::move(sets), definition.geometry, parts.threads, parts.halo));
}

}  // namespace mpm
