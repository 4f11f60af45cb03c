#include "contact_terms.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "mpm/contact/rigid_particle_contact.hpp"
#include "mpm/kernel/select.hpp"
#include "mpm/mechanics/nodal_volumes.hpp"
#include "rigid_contacts.hpp"
#include "state.hpp"

namespace mpm {
namespace {

int body_of(const std::string& name, const PairDefinition& pair, const std::vector<ParticleSet>& sets) {
  for (std::size_t s = 0; s < sets.size(); ++s) {
    if (sets[s].name == name) return static_cast<int>(s);
  }
  throw DefinitionError(fmt::format("contact of '{}' and '{}': no body is called '{}'", pair.first, pair.second, name));
}

bool is_rigid(const std::string& name, const SimulationDefinition& definition) {
  const auto& bodies = definition.rigid_bodies;
  return std::any_of(bodies.begin(), bodies.end(), [&](const RigidBodyDefinition& body) { return body.name == name; });
}

/// For displacements: before anything is sorted.
void remember_starts(std::vector<ParticleSet>& sets) {
  for (ParticleSet& set : sets) {
    if (set.start_x.empty()) set.start_x = set.x;
  }
}

}  // namespace

MaterialContactSettings make_contact_settings(const SimulationDefinition& definition, std::vector<ParticleSet>& sets,
                                              const FieldMap& map, const GridLayout& layout, int threads) {
  MaterialContactSettings settings;
  settings.normals = definition.contact.normals;
  settings.detection = definition.contact.detection;
  settings.geometry = definition.geometry;
  settings.threads = threads;
  settings.cell_volume = definition.across();
  for (int k = 0; k < layout.dim(); ++k) settings.cell_volume *= layout.cell(k);
  bool displacements = settings.detection.kind == Detection::displacements;
  for (const PairDefinition& pair : definition.contact.pairs) {
    if (is_rigid(pair.second, definition)) continue;  // simulation/rigid_contacts.cpp
    const int first = body_of(pair.first, pair, sets), second = body_of(pair.second, pair, sets);
    if (map.field(first) == map.field(second)) {
      throw DefinitionError(fmt::format("contact of '{}' and '{}': both are in velocity field {}; give each its own",
                                        pair.first, pair.second, definition.bodies[first].field));
    }
    displacements = displacements || pair.law.kind == ContactLaw::Kind::interface;
    MaterialPair made{pair.first + "/" + pair.second, map.fields(first), map.fields(second), pair.law};
    const auto same = std::find_if(settings.pairs.begin(), settings.pairs.end(), [&](const MaterialPair& other) {
      return (other.first == made.first && other.second == made.second) ||
             (other.first == made.second && other.second == made.first);
    });
    if (same == settings.pairs.end()) {
      settings.pairs.push_back(std::move(made));
    } else if (same->law.kind != ContactLaw::Kind::one_field || pair.law.kind != ContactLaw::Kind::one_field) {
      throw DefinitionError(fmt::format(
          "contact of '{}': a second law between the velocity fields of '{}'; leave one out", made.name, same->name));
    }
  }
  if (displacements) remember_starts(sets);
  return settings;
}

void Simulation::State::add_pairs() {
  MaterialContactSettings settings = make_contact_settings(definition, sets, field_map, layout(), threads);
  if (settings.pairs.empty()) return;
  settings.sides = sides.get();
  pairs = &modules.add(std::make_unique<MaterialContact>(std::move(settings), fields, volumes()));
}

namespace {

/// @throws DefinitionError for a body that cannot be free
void check_free(const SimulationDefinition& definition, const RigidBodyDefinition& body) {
  if (!body.free) return;
  const std::string start = fmt::format("rigid body '{}': free: ", body.name);
  if (definition.contact.method == ContactMethod::nodes || body.particles) {
    throw DefinitionError(start +
                          "a free body is met at points of the material's surface; write contact: {method: "
                          "points}, and leave out normals: particles");
  }
  if (body.inner_radius > 0.0) throw DefinitionError(start + "a ring that opens is not rigid; write another shape");
  if (body.free->axes == std::array<bool, 6>{}) throw DefinitionError(start + "no velocity is free; leave it out");
  if (!body.free->all_free() && body.free->centre != Vec3::Zero()) {
    throw DefinitionError(start +
                          "the centre of mass is off the body's origin, and a part of its motion is told; put "
                          "the origin at the centre of mass, or free all axes");
  }
}

/// Contact at nodes knows one constant friction a tool. @throws DefinitionError
void check_laws_at_nodes(const SimulationDefinition& definition, const RigidBodyDefinition& body) {
  const bool named = std::any_of(definition.contact.pairs.begin(), definition.contact.pairs.end(),
                                 [&](const PairDefinition& pair) { return pair.second == body.name; });
  if (!named && body.friction.static_coefficient < 0.0 && body.friction.adhesion == 0.0) return;
  throw DefinitionError(fmt::format(
      "rigid body '{}': contact at nodes has no laws of pairs, friction at rest or adhesion; write contact: "
      "{{method: points}}",
      body.name));
}

}  // namespace

void Simulation::State::add_rigid_bodies() {
  bodies.reserve(definition.rigid_bodies.size());
  for (const RigidBodyDefinition& body : definition.rigid_bodies) {
    bodies.emplace_back(body);
    check_periodic(bodies.back());
    check_free(definition, body);
  }
  const std::vector<ContactLaw> laws_of_pairs = rigid_contact_laws(definition, sets);
  const auto laws_of = [&](std::size_t body) { return laws_of_pairs.begin() + static_cast<int>(body * sets.size()); };
  contacts.resize(bodies.size());
  std::vector<const RigidBody*> met_at_points;
  std::vector<ContactLaw> laws_at_points;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const RigidBodyDefinition& body = bodies[b].definition();
    add_sides(bodies[b]);
    if (body.particles) {
      contacts[b] = &add_rigid_particles(bodies[b], {laws_of(b), laws_of(b + 1)});
    } else if (definition.contact.method == ContactMethod::nodes) {
      check_laws_at_nodes(definition, body);
      auto contact = std::make_unique<RigidContact>(bodies[b], fields, threads, definition.geometry, sides.get());
      contacts[b] = &modules.add(std::move(contact)).ledger();
    } else {
      met_at_points.push_back(&bodies[b]);
      laws_at_points.insert(laws_at_points.end(), laws_of(b), laws_of(b + 1));
    }
  }
  if (met_at_points.empty()) return;
  PointContactSettings settings{definition.geometry, definition.method.shape, definition.across(), threads, {}, {}};
  settings.gravity = definition.gravity;
  for (const RigidBody* body : met_at_points) {
    RigidBody& own = bodies[body - bodies.data()];
    settings.free.push_back(own.free_motion() != nullptr ? &own : nullptr);
  }
  auto contact = std::make_unique<PointContact>(met_at_points, sets, fields, std::move(laws_at_points), settings);
  for (std::size_t i = 0; i < met_at_points.size(); ++i) {
    contacts[met_at_points[i] - bodies.data()] = &contact->ledger(static_cast<int>(i));
  }
  modules.add(std::move(contact));
}

ContactLedger& Simulation::State::add_rigid_particles(const RigidBody& body,
                                                      const std::vector<ContactLaw>& laws_of_sets) {
  if (definition.contact.detection.kind == Detection::displacements) remember_starts(sets);
  RigidParticleSettings settings;
  settings.normals = definition.contact.normals;
  settings.detection = definition.contact.detection;
  settings.geometry = definition.geometry;
  settings.per_cell = definition.method.particles_per_direction;
  settings.across = definition.across();
  settings.laws.resize(fields.size());
  for (std::size_t s = 0; s < sets.size(); ++s) {
    for (const int field : field_map.fields(static_cast<int>(s))) settings.laws[field] = laws_of_sets[s];
  }
  auto stage = std::make_unique<RigidParticleContact>(body, std::move(settings), fields, volumes());
  return modules.add(std::move(stage)).ledger();
}

VolumeSurvey& Simulation::State::volumes() {
  if (survey) return *survey;
  std::vector<double> densities;
  for (const DeformableBody& body : definition.bodies) densities.push_back(find_material(definition, body).density);
  const auto make = [&](const auto& kernels) {
    survey = make_volume_survey(kernels, fields, sets, laws, densities, definition.geometry, threads);
  };
  if (definition.method.precision == Precision::float32) {
    make(kernel_table<float>(definition.method.shape, definition.geometry, isa));
  } else {
    make(kernel_table<double>(definition.method.shape, definition.geometry, isa));
  }
  return *survey;
}

}  // namespace mpm
