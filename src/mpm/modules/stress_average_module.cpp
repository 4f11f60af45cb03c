// Mean stresses of cells as a module, for bodies whose material can share its stress.
#include <fmt/core.h>

#include <algorithm>

#include "mpm/definition/definition.hpp"
#include "mpm/mechanics/stress_average.hpp"
#include "mpm/modules/shipped_modules.hpp"
#include "mpm/rules/method_rules.hpp"

namespace mpm {

void add_stress_average(RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  if (!averages_stress(definition.method, definition.geometry)) return;
  std::vector<AveragedSet> sets;
  for (std::size_t s = 0; s < parts.sets.size(); ++s) {
    if (shares_stress(definition, definition.bodies[s])) sets.push_back({&parts.sets[s], &parts.laws[s]});
  }
  if (sets.empty()) {
    if (!definition.method.average_stress) return;
    throw DefinitionError(fmt::format(
        "method.average_stress: no body has a stress that can be averaged; laws that have one are {}, and metal that "
        "expands with heat or moisture has none; leave it out",
        law_names([](const LawTraits& traits) { return traits.averages_stress; })));
  }
  parts.stress_average = &parts.modules.add(
      std::make_unique<StressAverage>(std::move(sets), definition.geometry, parts.threads, parts.halo));
}

}  // namespace mpm
