// Mean pressures of cells as a module, for the bodies whose law has a pressure in rate form: soil.
#include <algorithm>

#include "mpm/mechanics/pressure_average.hpp"
#include "mpm/simulation/simulation.hpp"
#include "shipped_modules.hpp"

namespace mpm {
namespace {

static_assert(DruckerPrager::kPlasticStrain == 0 && MohrCoulomb::kPlasticStrain == 0 && MuI::kPlasticStrain == 0);

/// The bulk modulus [Pa] of a law of soil; 0 of any other.
double soil_bulk(const LawDefinition& law) {
  if (const auto* soil = std::get_if<DruckerPragerDefinition>(&law)) return soil->elasticity.bulk();
  if (const auto* soil = std::get_if<MohrCoulombDefinition>(&law)) return soil->elasticity.bulk();
  if (const auto* grain = std::get_if<MuIDefinition>(&law)) return grain->elasticity.bulk();
  return 0.0;
}

}  // namespace

void add_pressure_average(RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  if (!definition.method.average_pressure) return;
  std::vector<AveragedSet> sets;
  for (std::size_t s = 0; s < parts.sets.size(); ++s) {
    const std::string& name = definition.bodies[s].material;
    const auto material = std::find_if(definition.materials.begin(), definition.materials.end(),
                                       [&](const MaterialDefinition& one) { return one.name == name; });
    const double bulk = soil_bulk(material->law);
    if (bulk > 0.0) sets.push_back({&parts.sets[s], bulk, material->density});
  }
  if (sets.empty()) {
    throw DefinitionError(
        "method.average_pressure: no body is of drucker_prager, mohr_coulomb or mu_i, whose pressures it averages; "
        "leave it "
        "out");
  }
  parts.modules.add(std::make_unique<PressureAverage>(std::move(sets), definition.geometry, parts.threads));
}

}  // namespace mpm
