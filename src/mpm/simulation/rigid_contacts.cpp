#include "rigid_contacts.hpp"

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

}  // namespace

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

}  // namespace mpm
