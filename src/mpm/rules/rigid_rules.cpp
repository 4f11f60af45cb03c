#include "mpm/rules/rigid_rules.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "mpm/contact/thin_tool.hpp"
#include "mpm/definition/rigid_contacts.hpp"
#include "mpm/math/geometry_kind.hpp"

namespace mpm {
namespace {

std::string divides_fault(const SimulationDefinition& definition, const RigidBodyDefinition& body) {
  if (body.divides.empty() || has_sides(body, definition.geometry, definition.smallest_cell())) return {};
  return "divides: it is too thick to divide anything (three cells or more); leave it out, or write sides: two";
}

std::string radial_fault(const SimulationDefinition& definition, const RigidBodyDefinition& body) {
  if (!axisymmetric(definition.geometry) || body.inner_radius > 0.0 || body.velocity[0].is_zero()) return {};
  return "it moves along r, off the axis; only a ring has a radial velocity";
}

std::string free_fault(const SimulationDefinition&, const RigidBodyDefinition& body) {
  if (!body.free) return {};
  if (body.free->axes == std::array<bool, 6>{}) return "free: no velocity is free; leave it out";
  if (!body.free->all_free() && body.free->centre != Vec3::Zero()) {
    return "free: the centre of mass is off the body's origin, and a part of its motion is prescribed; put the origin "
           "at the centre of mass, or free all axes";
  }
  return {};
}

std::string collide_fault(const SimulationDefinition& definition, const RigidBodyDefinition& body) {
  if (!body.collide || !axisymmetric(definition.geometry)) return {};
  return "collide: bodies about an axis do not meet each other; leave it out, or make the scene solid";
}

// Contact with rigid particles has one law for each velocity field.
std::string field_fault(const SimulationDefinition& definition, const RigidBodyDefinition& body) {
  if (!body.particles) return {};
  const auto& bodies = definition.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t k = i + 1; k < bodies.size(); ++k) {
      if (bodies[i].field != bodies[k].field) continue;
      const ContactLaw law = rigid_contact_law(definition, body, bodies[i].name);
      if (same_law(law, rigid_contact_law(definition, body, bodies[k].name))) continue;
      return fmt::format(
          "normals: particles: '{0}' and '{1}' have different laws with it, but share one velocity field and therefore "
          "one law; give both the same law with it, or '{0}' and '{1}' a law with each other in contact.pairs",
          bodies[i].name, bodies[k].name);
    }
  }
  return {};
}

}  // namespace

std::string rigid_fault(const SimulationDefinition& definition, const RigidBodyDefinition& body) {
  for (const auto rule : {divides_fault, radial_fault, free_fault, collide_fault, field_fault}) {
    if (std::string fault = rule(definition, body); !fault.empty()) return fault;
  }
  return {};
}

}  // namespace mpm
