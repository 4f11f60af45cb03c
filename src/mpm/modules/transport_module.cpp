// The transport of a definition as a module: its quantities, and what couples each to the motion.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "mpm/definition/definition.hpp"
#include "mpm/material/moduli.hpp"
#include "mpm/modules/shipped_modules.hpp"
#include "mpm/ranks/agree.hpp"
#include "mpm/transport/face_flux.hpp"
#include "mpm/transport/heat_gains.hpp"
#include "mpm/transport/transport.hpp"

namespace mpm {
namespace {

/// Speed of waves in the unstrained material [m/s].
double wave_speed(const Law& law) {
  return std::visit(
      [](const auto& own) { return own.wave_speed(Matrix3<double>::identity(), Symmetric3<double>{}, 1.0); }, law);
}

std::vector<FluxTerm> flux_terms(const QuantityDefinition& quantity, const RunParts& parts) {
  std::vector<FluxTerm> terms;
  for (const FluxDefinition& flux : quantity.fluxes) {
    const ChosenFaces faces = choose_faces(flux.body, flux.face, flux.particles, "flux", parts);
    terms.push_back({flux, faces.set, faces.face, faces.particles});
  }
  return terms;
}

std::vector<int> fields_of(const std::string& body, const RunParts& parts) {
  for (std::size_t s = 0; s < parts.sets.size(); ++s) {
    if (parts.sets[s].name == body) return parts.map.fields(static_cast<int>(s));
  }
  throw DefinitionError(fmt::format("transport.temperature.pairs: no deformable body is called '{}'", body));
}

/// The heat that contact gives, for contact to tell it.
SurfaceHeat* add_surface_heat(TransportedField& temperature, RunParts& parts) {
  const QuantityDefinition& quantity = temperature.definition();
  std::vector<double> effusivities(parts.fields.size(), 0.0);
  for (std::size_t s = 0; s < parts.sets.size(); ++s) {
    const TransportMaterial& own = temperature.material(static_cast<int>(s));
    const double at = quantity.reference;
    const double product =
        own.conductivity(at) * own.capacity(at) * find_material(parts.definition, parts.definition.bodies[s]).density;
    for (const int field : parts.map.fields(static_cast<int>(s))) effusivities[field] = std::sqrt(product);
  }
  std::vector<ToolHeat> tools(parts.bodies.size());
  for (const ToolHeatDefinition& tool : quantity.tools) {
    const auto body = std::find_if(parts.bodies.begin(), parts.bodies.end(),
                                   [&](const RigidBody& b) { return b.name() == tool.body; });
    if (body == parts.bodies.end()) {
      throw DefinitionError(fmt::format("transport.temperature.tools: no rigid body is called '{}'", tool.body));
    }
    if (body->definition().particles) {
      throw DefinitionError(fmt::format(
          "transport.temperature.tools: '{}' is made of particles and met at nodes, where no area of contact "
          "is known; leave out its normals: particles",
          tool.body));
    }
    tools[body - parts.bodies.begin()].definition = tool;
  }
  const std::size_t fields = parts.fields.size();
  std::vector<double> pairs(fields * fields, 0.0);
  for (const PairHeatDefinition& pair : quantity.pairs) {
    const auto first = fields_of(pair.first, parts), second = fields_of(pair.second, parts);
    const bool faces = pair.first == pair.second && first.size() > 1;  // those of its cracks
    if (first[0] == second[0] && !faces) {
      throw DefinitionError(
          fmt::format("transport.temperature.pairs: '{}' and '{}' share one velocity field, in which heat flows by the "
                      "material's own conductivity; give them a law of contact, or leave the pair out",
                      pair.first, pair.second));
    }
    for (const int one : first) {
      for (const int other : second) pairs[one * fields + other] = pairs[other * fields + one] = pair.conductance;
    }
  }
  auto heat = std::make_unique<SurfaceHeat>(parts.fields, parts.bodies, std::move(effusivities), std::move(tools),
                                            std::move(pairs), parts.ranks);
  SurfaceHeat* told = heat.get();
  temperature.add(std::move(heat));
  return told;
}

std::unique_ptr<TransportedField> make_field(const QuantityDefinition& quantity, const TransportParts& shared,
                                             RunParts& parts) {
  try {
    return std::make_unique<TransportedField>(quantity, shared, parts.make_transfer(parts.definition.method.shape));
  } catch (const FunctionError& error) {
    throw DefinitionError(
        fmt::format("transport.{}.initial, or one of its values: {}", traits_of(quantity.quantity).name, error.what()));
  }
}

void couple_heat(TransportedField& temperature, RunParts& parts, GeometryKind geometry) {
  std::vector<HeatOfSet> heat;
  for (std::size_t s = 0; s < parts.sets.size(); ++s) {
    const MaterialDefinition& material = find_material(parts.definition, parts.definition.bodies[s]);
    HeatOfSet of{&parts.laws[s], temperature.material(static_cast<int>(s)), material.density, 0.0};
    if (temperature.definition().compression_heat) of.bulk = constant_bulk_modulus(material);
    heat.push_back(std::move(of));
  }
  auto plastic = std::make_unique<PlasticHeat>(parts.sets, heat);
  if (plastic->any()) temperature.add(std::move(plastic));
  auto compression = std::make_unique<CompressionHeat>(parts.sets, geometry, heat);
  auto own = std::make_unique<LawTemperature>(parts.sets, geometry, heat);
  bool compresses = false, has_own = false;
  for (int s = 0; s < static_cast<int>(parts.sets.size()); ++s) {
    compresses = compresses || compression->acts_on(s);
    has_own = has_own || own->acts_on(s);
  }
  for (int s = 0; s < static_cast<int>(parts.sets.size()); ++s) {
    if (!own->acts_on(s)) continue;
    temperature.start_from(s, [&](int p) { return own->value(s, p); });
  }
  if (compresses) temperature.add(std::move(compression));
  if (has_own) temperature.add(std::move(own));
}

void let_sleep(TransportedField& field, const RunParts& parts) {
  const SleepDefinition& sleep = *parts.definition.sleep;
  const std::optional<double> changes[] = {sleep.temperature, sleep.concentration,
                                           sleep.pore_pressure};  // in the order of Transported
  try {
    field.let_sleep(changes[static_cast<int>(field.quantity())], sleep.after);
  } catch (const TransportError& error) {
    throw DefinitionError(error.what());
  }
}

}  // namespace

void add_transport(RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  const TransportDefinition& asked = definition.transport;
  if (asked.quantities.empty()) return;
  if (definition.sleep && parts.ranks != nullptr) {
    throw DefinitionError(
        "transport: beside sleep it runs in one process; start one, or leave one of the two sections out");
  }
  TransportParts shared{parts.fields,
                        parts.sets,
                        definition.geometry,
                        definition.method.shape,
                        parts.threads,
                        {},
                        {},
                        definition.gravity,
                        parts.choice != nullptr,
                        definition.sleep.has_value(),
                        parts.ranks,
                        parts.interrupt};
  std::vector<double> speeds;
  for (std::size_t s = 0; s < parts.sets.size(); ++s) {
    const MaterialDefinition& material = find_material(parts.definition, parts.definition.bodies[s]);
    shared.materials.push_back(static_cast<int>(&material - definition.materials.data()));
    shared.densities.push_back(material.density);
    speeds.push_back(wave_speed(parts.laws[s]));
  }
  auto transport = std::make_unique<Transport>(shared, definition.time.sync, std::move(speeds));
  const ShapeKind shape = definition.method.shape;
  for (const QuantityDefinition& quantity : asked.quantities) {
    std::unique_ptr<TransportedField> field;
    agree<DefinitionError>(parts.ranks, [&] { field = make_field(quantity, shared, parts); });
    if (parts.ranks != nullptr) field->share_limits(*parts.ranks);
    if (!quantity.fluxes.empty()) {
      const FaceSettings faces{definition.geometry, shape, definition.across(), parts.choice, parts.halo};
      field->add(std::make_unique<FaceFlux>(faces, parts.fields, parts.sets, flux_terms(quantity, parts)));
    }
    if (quantity.quantity == Transported::temperature) {
      couple_heat(*field, parts, definition.geometry);
      SurfaceHeat* heat = add_surface_heat(*field, parts);
      parts.heat = heat;
      parts.temperature = field.get();
      transport->set_surface_heat(heat);
    }
    if (quantity.quantity == Transported::pore_pressure) {
      std::vector<TransportMaterial> of_set;
      for (std::size_t s = 0; s < parts.sets.size(); ++s) of_set.push_back(field->material(static_cast<int>(s)));
      field->add(std::make_unique<SkeletonGain>(shared, of_set));
      const bool averaged = definition.method.average_dilatation;
      transport->add(std::make_unique<PoreWater>(*field, shared, parts.make_transfer(shape), averaged));
    }
    if (definition.sleep) let_sleep(*field, parts);
    transport->add(std::move(field));
  }
  transport->prepare_expansion([&] { return parts.make_transfer(shape); });
  parts.rest_partners.push_back(&parts.modules.add(std::move(transport)));
}

}  // namespace mpm
