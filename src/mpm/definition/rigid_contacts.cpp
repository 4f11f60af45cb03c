#include "mpm/definition/rigid_contacts.hpp"

#include <algorithm>

namespace mpm {
namespace {

ContactLaw always(const FrictionLaw& friction) {
  ContactLaw law;
  law.kind = friction.stick ? ContactLaw::Kind::stick : ContactLaw::Kind::coulomb;
  law.friction = friction.coefficient;
  if (friction.static_coefficient >= 0.0) law.static_friction = friction.static_coefficient;
  law.adhesion = friction.adhesion;
  return law;
}

bool same_function(const Function& a, const Function& b) {
  if (a.is_constant() || b.is_constant()) return a.is_constant() == b.is_constant() && a(0.0) == b(0.0);
  return a.text() == b.text();
}

}  // namespace

bool same_law(const ContactLaw& a, const ContactLaw& b) {
  if (a.kind != b.kind || a.static_friction.has_value() != b.static_friction.has_value()) return false;
  if (a.static_friction && !same_function(*a.static_friction, *b.static_friction)) return false;
  return same_function(a.friction, b.friction) && same_function(a.adhesion, b.adhesion);
}

ContactLaw rigid_contact_law(const SimulationDefinition& definition, const RigidBodyDefinition& body,
                             const std::string& deformable) {
  const auto& pairs = definition.contact.pairs;
  const auto pair = std::find_if(pairs.begin(), pairs.end(), [&](const PairDefinition& p) {
    return p.first == deformable && p.second == body.name;
  });
  return pair != pairs.end() ? pair->law : always(body.friction);
}

std::vector<ContactLaw> rigid_contact_laws(const SimulationDefinition& definition,
                                           const std::vector<ParticleSet>& sets) {
  std::vector<ContactLaw> laws;
  for (const RigidBodyDefinition& body : definition.rigid_bodies) {
    for (const ParticleSet& set : sets) laws.push_back(rigid_contact_law(definition, body, set.name));
  }
  return laws;
}

BodyContactSettings body_contact_settings(const SimulationDefinition& definition) {
  BodyContactSettings settings;
  settings.geometry = definition.geometry;
  settings.cell = definition.smallest_cell();
  settings.gravity = definition.gravity.norm();
  for (std::size_t w = 0; w < definition.walls.size(); ++w) {
    const WallKind kind = definition.walls[w].kind;
    if (kind != WallKind::fixed && kind != WallKind::slip && kind != WallKind::frictional) continue;
    const int axis = static_cast<int>(w / 2);
    const bool upper = w % 2 != 0;
    BodyWall wall;
    wall.name = kWallNames[w];
    wall.normal = (upper ? -1.0 : 1.0) * Vec3::Unit(axis);
    wall.place = upper ? -definition.grid.max[axis] : definition.grid.min[axis];
    if (kind == WallKind::slip) wall.friction = 0.0;
    if (kind == WallKind::frictional) wall.friction = definition.walls[w].friction.coefficient;
    settings.walls.push_back(wall);
  }
  return settings;
}

}  // namespace mpm
