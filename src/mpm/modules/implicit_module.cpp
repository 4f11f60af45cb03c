// Implicit steps of soil as a module: cells, contact with tools and walls, which a scene with explicit steps has as
// modules of their own.
#include <fmt/core.h>

#include <algorithm>

#include "mpm/definition/definition.hpp"
#include "mpm/definition/rigid_contacts.hpp"
#include "mpm/implicit/implicit_step.hpp"
#include "mpm/modules/shipped_modules.hpp"

namespace mpm {

void add_implicit(RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  if (definition.method.update != UpdateScheme::implicit) return;
  ImplicitParts made;
  std::vector<std::string> soils;
  for (std::size_t s = 0; s < parts.sets.size(); ++s) {
    const MaterialDefinition& material = find_material(definition, definition.bodies[s]);
    const auto known = std::find(soils.begin(), soils.end(), material.name);
    made.bodies.list.push_back({&parts.sets[s], static_cast<int>(known - soils.begin())});
    if (known != soils.end()) continue;
    soils.push_back(material.name);
    made.bodies.soils.emplace_back(material);
  }
  made.sets = &parts.sets;
  const std::vector<ContactLaw> laws = rigid_contact_laws(definition, parts.sets);
  for (std::size_t b = 0; b < parts.bodies.size(); ++b) {
    made.tools.push_back(&parts.bodies[b]);
    made.laws.push_back(laws[b * parts.sets.size()]);
  }
  made.grid = parts.contact_fields().front().get();
  ImplicitSettings settings;
  settings.geometry = definition.geometry;
  settings.across = definition.across();
  settings.sweeps = definition.method.sweeps;
  settings.walls = definition.walls;
  settings.threads = parts.threads;
  settings.gravity = definition.gravity;
  settings.meeting = body_contact_settings(definition);
  settings.loads =
      !definition.body_forces.empty() || !definition.particle_forces.empty() || !definition.tractions.empty();
  settings.isa = parts.isa;
  if (definition.time.budget) {
    parts.services.budget = std::make_unique<SweepBudget>(*definition.time.budget);
    parts.notes.push_back(
        "time.budget: sweeps end by the wall clock, so that no two runs have the same bits; run_scene --from-bag makes "
        "a recorded one again");
  }
  settings.budget = parts.services.budget.get();
  parts.modules.add(make_implicit_step(std::move(made), settings, definition.method.precision));
}

}  // namespace mpm
