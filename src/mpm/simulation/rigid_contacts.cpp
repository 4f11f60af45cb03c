#include "rigid_contacts.hpp"

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

std::vector<ContactLaw> rigid_contact_laws(const SimulationDefinition& definition,
                                           const std::vector<ParticleSet>& sets) {
  std::vector<ContactLaw> laws;
  for (const RigidBodyDefinition& body : definition.rigid_bodies) {
    for (std::size_t s = 0; s < sets.size(); ++s) laws.push_back(always(body.friction));
  }
  return laws;
}

}  // namespace mpm
