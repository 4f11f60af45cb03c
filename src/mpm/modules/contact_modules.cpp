// Contact of a definition as modules: between deformable bodies, whose names become velocity fields, and with rigid
// bodies. Before anything is sorted: sets begin to remember where their particles start where displacements, or areas
// at the start about an axis, are asked for.
#include <fmt/core.h>

#include <algorithm>

#include "mpm/contact/material_contact.hpp"
#include "mpm/contact/point_contact.hpp"
#include "mpm/contact/rigid_contact.hpp"
#include "mpm/contact/rigid_particle_contact.hpp"
#include "mpm/contact/tool_sides.hpp"
#include "mpm/definition/definition.hpp"
#include "mpm/definition/rigid_contacts.hpp"
#include "mpm/modules/shipped_modules.hpp"

namespace mpm {
namespace {

int body_of(const std::string& name, const PairDefinition& pair, const std::vector<ParticleSet>& sets) {
  for (std::size_t s = 0; s < sets.size(); ++s) {
    if (sets[s].name == name) return static_cast<int>(s);
  }
  throw DefinitionError(fmt::format("contact of '{}' and '{}': no body is called '{}'", pair.first, pair.second, name));
}

bool share_a_field(const std::vector<int>& a, const std::vector<int>& b) {
  return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

bool is_rigid(const std::string& name, const SimulationDefinition& definition) {
  const auto& bodies = definition.rigid_bodies;
  return std::any_of(bodies.begin(), bodies.end(), [&](const RigidBodyDefinition& body) { return body.name == name; });
}

/// True if two deformable bodies have a law with each other.
bool has_pairs(const SimulationDefinition& definition) {
  const auto& pairs = definition.contact.pairs;
  return std::any_of(pairs.begin(), pairs.end(),
                     [&](const PairDefinition& pair) { return !is_rigid(pair.second, definition); });
}

/// True if contact asks for the material's places at the start.
bool needs_starts(const SimulationDefinition& definition) {
  const DetectionRule& rule = definition.contact.detection;
  return rule.kind == Detection::displacements || (axisymmetric(definition.geometry) && rule.minimum_volume > 0.0);
}

/// Before anything is sorted.
void remember_starts(std::vector<ParticleSet>& sets) {
  for (ParticleSet& set : sets) {
    if (set.start_x.empty()) set.start_x = set.x;
  }
}

/// @throws DefinitionError for a pair that names no body, or bodies of one field; for two laws between the same fields
MaterialContactSettings pair_settings(RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  std::vector<ParticleSet>& sets = parts.sets;
  const FieldMap& map = parts.map;
  const GridLayout& layout = parts.layout();
  MaterialContactSettings settings;
  settings.normals = definition.contact.normals;
  settings.detection = definition.contact.detection;
  settings.geometry = definition.geometry;
  settings.threads = parts.threads;
  settings.sides = parts.sides;
  settings.heat = parts.heat;
  settings.ranks = parts.ranks;
  settings.cell_volume = definition.across();
  for (int k = 0; k < layout.dim(); ++k) settings.cell_volume *= layout.cell(k);
  bool starts = needs_starts(definition);
  for (const PairDefinition& pair : definition.contact.pairs) {
    if (is_rigid(pair.second, definition)) continue;  // definition/rigid_contacts.cpp
    const int first = body_of(pair.first, pair, sets), second = body_of(pair.second, pair, sets);
    if (map.field(first) == map.field(second)) {
      throw DefinitionError(fmt::format("contact of '{}' and '{}': both are in velocity field {}; give each its own",
                                        pair.first, pair.second, definition.bodies[first].field));
    }
    starts = starts || pair.law.kind == ContactLaw::Kind::interface;
    MaterialPair made{pair.first + "/" + pair.second, map.fields(first), map.fields(second), pair.law};
    const auto same = std::find_if(settings.pairs.begin(), settings.pairs.end(), [&](const MaterialPair& other) {
      return (share_a_field(other.first, made.first) && share_a_field(other.second, made.second)) ||
             (share_a_field(other.first, made.second) && share_a_field(other.second, made.first));
    });
    const auto joins = [](const ContactLaw& law) { return law.kind == ContactLaw::Kind::one_field; };
    if (same == settings.pairs.end() || (joins(same->law) && joins(made.law))) {
      settings.pairs.push_back(std::move(made));
    } else {
      throw DefinitionError(fmt::format(
          "contact of '{}': a second law between the velocity fields of '{}'; leave one out", made.name, same->name));
    }
  }
  if (starts) remember_starts(sets);
  return settings;
}

RigidParticleSettings particle_settings(RunParts& parts, const std::vector<ContactLaw>& laws_of_sets) {
  const SimulationDefinition& definition = parts.definition;
  if (needs_starts(definition)) remember_starts(parts.sets);
  RigidParticleSettings settings;
  settings.normals = definition.contact.normals;
  settings.detection = definition.contact.detection;
  settings.geometry = definition.geometry;
  settings.per_cell = definition.method.particles_per_direction;
  settings.ranks = parts.ranks;
  settings.across = definition.across();
  settings.laws.resize(parts.fields.size());
  for (std::size_t s = 0; s < parts.sets.size(); ++s) {
    for (const int field : parts.map.fields(static_cast<int>(s))) settings.laws[field] = laws_of_sets[s];
  }
  return settings;
}

/// Contact at points, with all of these bodies at once. `laws`: of each against each set.
void add_point_contact(RunParts& parts, const std::vector<RigidBody*>& bodies, std::vector<ContactLaw> laws) {
  const SimulationDefinition& definition = parts.definition;
  PointContactSettings settings{definition.geometry, definition.method.shape,
                                definition.across(), parts.threads,
                                definition.gravity,  has_pairs(definition) || parts.choice != nullptr,
                                parts.heat,          definition.contact.sharp_edges,
                                parts.ranks,         body_contact_settings(definition),
                                parts.choice};
  const std::vector<ParticleSet>& sets = parts.near_bodies != nullptr ? *parts.near_bodies : parts.sets;
  auto contact = std::make_unique<PointContact>(bodies, sets, parts.contact_fields(), std::move(laws), settings);
  parts.at_points = contact.get();
  parts.modules.add(std::move(contact));
}

/// One mark for each velocity field, not 0 for those of bodies that cracks divide.
std::vector<std::uint8_t> divided_fields(const RunParts& parts) {
  std::vector<std::uint8_t> divided(parts.fields.size(), 0);
  for (const int field : parts.map.chosen()) divided[field] = 1;
  return divided;
}

/// One mark for each velocity field, not 0 for those of bodies that cracks and this thin tool divide.
std::vector<std::uint8_t> fields_divided_by(const RigidBody& body, const RunParts& parts) {
  std::vector<std::uint8_t> divided(parts.fields.size(), 0);
  if (parts.sides == nullptr || parts.sides->find(body) == nullptr) return divided;
  for (std::size_t s = 0; s < parts.sets.size(); ++s) {
    if (!parts.sets[s].chooses || !divides(body.definition(), parts.sets[s].name)) continue;
    for (const int field : parts.map.fields(static_cast<int>(s))) divided[field] = 1;
  }
  return divided;
}

}  // namespace

void add_pairs(RunParts& parts) {
  MaterialContactSettings settings = pair_settings(parts);
  if (settings.normals.method == NormalMethod::own) {
    parts.warnings.push_back(
        "contact.normals: 'own' keeps neither momentum nor energy where the normals of two sides are not opposite (the "
        "audit's account contact_normals shows how much): a stack at rest can gain energy. It is for comparison with "
        "other programs; use average elsewhere");
  }
  if (settings.pairs.empty()) return;
  parts.modules.add(std::make_unique<MaterialContact>(std::move(settings), parts.fields, parts.volumes()));
}

void add_rigid_contact(RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  if (definition.method.update == UpdateScheme::implicit) return;  // implicit_module.cpp
  const std::vector<ContactLaw> laws = rigid_contact_laws(definition, parts.sets);
  std::vector<RigidBody*> met_at_points;
  std::vector<ContactLaw> laws_at_points;
  for (std::size_t b = 0; b < parts.bodies.size(); ++b) {
    RigidBody& body = parts.bodies[b];
    const auto first = laws.begin() + static_cast<std::ptrdiff_t>(b * parts.sets.size());
    const std::vector<ContactLaw> own(first, first + static_cast<std::ptrdiff_t>(parts.sets.size()));
    if (body.definition().particles) {
      parts.modules.add(
          std::make_unique<RigidParticleContact>(body, particle_settings(parts, own), parts.fields, parts.volumes()));
    } else if (definition.contact.method == ContactMethod::nodes) {
      auto contact = std::make_unique<RigidContact>(body, parts.contact_fields(), parts.threads, definition.geometry,
                                                    parts.sides, definition.gravity, parts.heat);
      if (parts.choice != nullptr) {
        contact->take_normals_at_centres(divided_fields(parts));
        contact->divide(fields_divided_by(body, parts));
      }
      parts.modules.add(std::move(contact));
    } else {
      met_at_points.push_back(&body);
      laws_at_points.insert(laws_at_points.end(), own.begin(), own.end());
    }
  }
  if (!met_at_points.empty()) add_point_contact(parts, met_at_points, std::move(laws_at_points));
}

}  // namespace mpm
