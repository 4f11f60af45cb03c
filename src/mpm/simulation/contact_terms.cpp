#include "contact_terms.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace mpm {
namespace {

std::vector<int> fields_of(const ParticleSet& set) {
  std::vector<int> fields{set.field};
  if (!set.side.empty()) fields.push_back(set.field + 1);
  return fields;
}

const ParticleSet& set_of(const std::string& name, const PairDefinition& pair, const std::vector<ParticleSet>& sets) {
  for (const ParticleSet& set : sets) {
    if (set.name == name) return set;
  }
  throw DefinitionError(fmt::format("contact of '{}' and '{}': no body is called '{}'", pair.first, pair.second, name));
}

bool is_rigid(const std::string& name, const SimulationDefinition& definition) {
  const auto& bodies = definition.rigid_bodies;
  return std::any_of(bodies.begin(), bodies.end(), [&](const RigidBodyDefinition& body) { return body.name == name; });
}

}  // namespace

MaterialContactSettings make_contact_settings(const SimulationDefinition& definition, std::vector<ParticleSet>& sets,
                                              const GridLayout& layout, int threads) {
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
    const ParticleSet &first = set_of(pair.first, pair, sets), &second = set_of(pair.second, pair, sets);
    if (first.field == second.field) {
      throw DefinitionError(fmt::format("contact of '{}' and '{}': both are in velocity field {}; give each its own",
                                        pair.first, pair.second, first.field));
    }
    displacements = displacements || pair.law.kind == ContactLaw::Kind::interface;
    MaterialPair made{pair.first + "/" + pair.second, fields_of(first), fields_of(second), pair.law};
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
  for (ParticleSet& set : sets) {
    if (displacements && set.start_x.empty()) set.start_x = set.x;
  }
  return settings;
}

}  // namespace mpm
