// Mean stresses of cells as a module, for the bodies of soil.
#include <algorithm>

#include "mpm/mechanics/stress_average.hpp"
#include "mpm/simulation/method_rules.hpp"
#include "mpm/simulation/simulation.hpp"
#include "shipped_modules.hpp"

namespace mpm {
namespace {

static_assert(DruckerPrager::kPlasticStrain == 0 && MohrCoulomb::kPlasticStrain == 0 && MuI::kPlasticStrain == 0);

}  // namespace

void add_stress_average(RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  if (!averages_stress(definition.method, definition.geometry)) return;
  std::vector<AveragedSet> sets;
  for (std::size_t s = 0; s < parts.sets.size(); ++s) {
    const std::string& name = definition.bodies[s].material;
    const auto material = std::find_if(definition.materials.begin(), definition.materials.end(),
                                       [&](const MaterialDefinition& one) { return one.name == name; });
    const Elasticity* elasticity = averaged_elasticity(material->law);
    if (elasticity != nullptr) {
      sets.push_back({&parts.sets[s], elasticity->bulk(), elasticity->shear(), material->density});
    }
  }
  if (sets.empty()) {
    if (!definition.method.average_stress) return;
    throw DefinitionError(
        "method.average_stress: no body is of drucker_prager, mohr_coulomb or mu_i, whose stresses it averages; leave "
        "it out");
  }
  parts.modules.add(std::make_unique<StressAverage>(std::move(sets), definition.geometry, parts.threads, parts.halo));
}

}  // namespace mpm
