// The explicit cracks of a definition as modules.
#include <fmt/core.h>

#include <algorithm>

#include "mpm/contact/point_contact.hpp"
#include "mpm/contact/tool_sides.hpp"
#include "mpm/crack/crack_cells.hpp"
#include "mpm/crack/crack_stage.hpp"
#include "mpm/crack/periodic_reach.hpp"
#include "mpm/definition/definition.hpp"
#include "mpm/kernel/select.hpp"
#include "mpm/mechanics/continuum.hpp"
#include "mpm/mechanics/stress_average.hpp"
#include "mpm/modules/shipped_modules.hpp"
#include "mpm/modules/with_precision.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/transport/transported_field.hpp"

namespace mpm {
namespace {

/// Energies that growth can be paid from: dissipation by damping and transfer is how the waves of growth leave the
/// body.
BodyEnergies body_energies(const EnergyReport& energy) {
  const double plastic = energy.of("plastic");
  return {energy.balance() - plastic - energy.of("damping") - energy.of("transfer"), plastic};
}

TipSettings tip_settings(const RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  const CracksDefinition& asked = definition.cracks;
  TipSettings settings{
      asked.contour, asked.split, asked.growth, asked.alternate, asked.length, asked.time_factor, {}, {}, {}};
  settings.energies = [energies = parts.energies] { return body_energies(energies()); };
  for (std::size_t m = 0; m < definition.materials.size(); ++m) {
    const MaterialDefinition& material = definition.materials[m];
    FractureMaterial made;
    made.name = material.name;
    if (m < asked.materials.size()) made.constants = asked.materials[m];
    made.elastic = elastic_constants_of(material, definition.geometry);
    if (const auto* pores = definition.transport.find(Transported::pore_pressure);
        pores != nullptr && made.elastic && closed(pores->materials[m])) {
      made.elastic = undrained(*made.elastic, pores->materials[m]);
    }
    made.wave_speed = made.elastic ? made.elastic->dilatational_speed() : 0.0;
    settings.materials.push_back(std::move(made));
  }
  for (const DeformableBody& body : definition.bodies) {
    const MaterialDefinition& material = find_material(definition, body);
    settings.material_of_set.push_back(static_cast<int>(&material - definition.materials.data()));
  }
  for (std::size_t s = 0; s < parts.sets.size(); ++s) {
    FractureMaterial& material = settings.materials[settings.material_of_set[s]];
    if (material.wave_speed > 0.0) continue;
    material.wave_speed = std::visit(
        [](const auto& own) { return own.wave_speed(Matrix3<double>::identity(), Symmetric3<double>{}, 1.0); },
        parts.laws[s]);
  }
  return settings;
}

/// Physics of each set; empty where nothing expands and no water is in pores.
std::vector<TipPhysics> tip_physics(const RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  const QuantityDefinition* pores = definition.transport.find(Transported::pore_pressure);
  const char* name = traits_of(Transported::pore_pressure).name;
  std::vector<TipPhysics> list;
  bool any = false;
  for (std::size_t s = 0; s < parts.sets.size(); ++s) {
    const MaterialDefinition& material = find_material(definition, definition.bodies[s]);
    TipPhysics physics;
    physics.expands = parts.sets[s].free_strain >= 0;
    if (pores != nullptr) {
      const auto& brought = parts.sets[s].brought;
      for (std::size_t n = 0; n < brought.size(); ++n) {
        if (brought[n].name == name) physics.pressure = static_cast<int>(n) + 1;  // the next one is what is carried
      }
      physics.pores = pores->materials[&material - definition.materials.data()];
      physics.undrained = closed(physics.pores);
      if (const auto elastic = elastic_constants_of(material, definition.geometry)) {
        physics.bulk = elastic->youngs / (3.0 * (1.0 - 2.0 * elastic->poisson));
      }
    }
    any = any || physics.any();
    list.push_back(physics);
  }
  if (!any) list.clear();
  return list;
}

/// The thin tools that divide bodies which cracks divide.
ToolCuts tool_cuts(const RunParts& parts) {
  std::vector<ToolCuts::Cut> cuts;
  for (std::size_t t = 0; parts.sides != nullptr && t < parts.sides->tools().size(); ++t) {
    ToolCuts::Cut cut{&parts.sides->tools()[t], {}};
    for (const ParticleSet& set : parts.sets) {
      cut.divides.push_back(set.chooses && divides(cut.tool->body().definition(), set.name) ? 1 : 0);
    }
    if (std::count(cut.divides.begin(), cut.divides.end(), 1) > 0) cuts.push_back(std::move(cut));
  }
  return {std::move(cuts), static_cast<int>(parts.definition.cracks.list.size())};
}

void check(const RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  const auto refuse = [](const std::string& what) { throw DefinitionError("cracks: " + what); };
  if (parts.choice == nullptr) refuse("no body heeds any of them; leave the section out, or name a body that does");
  if (definition.cracks.heating > 0.0 && parts.temperature == nullptr) {
    refuse("heating needs a temperature; write transport: {temperature: {}}");
  }
}

}  // namespace

void add_cracks(RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  const CracksDefinition& asked = definition.cracks;
  if (!asked.any()) return;
  check(parts);
  auto made = std::make_unique<CrackStage::Parts>();
  made->sets = &parts.sets;
  made->masses = parts.make_transfer(definition.method.shape);
  made->sync = seconds_of(definition.time.sync);
  for (const CrackDefinition& crack : asked.list) {
    Crack one{
        crack, Chain(crack.points, crack.ends, crack.fixed), {}, crack.faces.law.kind != ContactLaw::Kind::one_field};
    for (const ParticleSet& set : parts.sets) one.divides.push_back(asked.divides(crack, set.name) ? 1 : 0);
    made->cracks.push_back(std::move(one));
  }
  made->contour = asked.contour.size;
  if (const std::string fault = periodic_fault(made->cracks, parts.layout(), made->contour); !fault.empty()) {
    throw DefinitionError(fault);
  }
  for (ParticleSet& set : parts.sets) {
    if (set.start_x.empty()) set.start_x = set.x;
  }
  const Grouping grouping = with_precision(definition.method.precision, [&](auto zero) {
    return kernel_grouping(kernel_table<decltype(zero)>(definition.method.shape, definition.geometry, parts.isa));
  });
  const double across = definition.across();
  const auto make_sides = [&] {
    return std::make_unique<SidePlaces>(parts.make_transfer(definition.method.shape), parts.fields,
                                        parts.choice->grid(), parts.sets);
  };
  made->jumps = std::make_unique<FieldJumps>(parts.fields, asked.length);
  made->chosen =
      std::make_unique<CrackFields>(made->cracks, parts.sets, *parts.choice, *made->jumps, parts.map, grouping,
                                    definition.method.shape, tool_cuts(parts), parts.threads, parts.ranks);
  // Contours and what lies ahead of tips, with the nodes around them.
  const double reach = 2.0 + std::max(static_cast<double>(asked.contour.size), asked.length);
  made->reach = reach;
  if (parts.at_points != nullptr) parts.at_points->divide(*made->chosen);
  if (parts.halo != nullptr) {
    parts.halo->add_everywhere(
        [chosen = made->chosen.get(), reach](const std::array<int, 3>& block) { return chosen->near(block, reach); });
  }
  if (parts.stress_average != nullptr) {
    parts.stress_average->divide(
        *parts.choice, std::make_unique<CrackCells>(made->cracks, made->chosen->cuts(), parts.sets, parts.layout()));
  }
  made->counts = is_first(parts.ranks);
  made->motion = std::make_unique<CrackMotion>(made->cracks, *made->chosen, parts.fields, asked.move, asked.prevent);
  try {
    made->tractions = std::make_unique<CrackTractions>(made->cracks, *made->chosen, parts.fields, asked.laws,
                                                       definition.geometry, across);
  } catch (const CrackError& error) {
    throw DefinitionError(error.what());
  }
  TipParts tip_parts{made->cracks, *made->chosen,       parts.fields, parts.sets, parts.laws,
                     {},           definition.geometry, across};
  tip_parts.grid_energy = asked.contour.energy == ContourDefinition::Energy::grid;
  tip_parts.physics = tip_physics(parts);
  tip_parts.ranks = parts.ranks;
  for (const DeformableBody& body : definition.bodies) {
    tip_parts.densities.push_back(find_material(definition, body).density);
  }
  made->tips =
      std::make_unique<CrackTips>(made->cracks, *made->chosen, *made->tractions, *made->jumps, std::move(tip_parts),
                                  parts.make_transfer(definition.method.shape), tip_settings(parts));
  if (asked.heating > 0.0) {
    std::vector<int> crack_of_tip;
    for (const CrackTip& tip : made->tips->tips()) crack_of_tip.push_back(tip.crack);
    auto heating = std::make_unique<TipHeating>(asked.heating, crack_of_tip, *made->chosen, parts.fields, made->counts);
    made->tips->set_heating(heating.get());
    parts.temperature->add(std::move(heating));
  }
  parts.modules.add(std::make_unique<CrackContact>(made->cracks, *made->chosen, parts.fields, make_sides(),
                                                   parts.volumes(), definition.geometry, parts.threads, parts.heat));
  parts.rest_partners.push_back(&parts.modules.add(std::make_unique<CrackStage>(std::move(made))));
}

}  // namespace mpm
