// The laws of contact of every rigid body against every deformable one.
#pragma once

#include <string>
#include <vector>

#include "mpm/contact/body_contact.hpp"
#include "mpm/definition/definition.hpp"
#include "mpm/particles/particle_set.hpp"

namespace mpm {

/// The law of a rigid body against a deformable one: that of the pair, or where the scene names none the body's own
/// friction.
ContactLaw rigid_contact_law(const SimulationDefinition& definition, const RigidBodyDefinition& body,
                             const std::string& deformable);

bool same_law(const ContactLaw& a, const ContactLaw& b);

/// Laws of every rigid body against every set; the sets of a body together.
std::vector<ContactLaw> rigid_contact_laws(const SimulationDefinition& definition,
                                           const std::vector<ParticleSet>& sets);

/// Contact of rigid bodies with each other, and with the walls of the domain: those that are fixed, slip (without
/// friction) or frictional. A face of symmetry is no wall to a body.
BodyContactSettings body_contact_settings(const SimulationDefinition& definition);

}  // namespace mpm
