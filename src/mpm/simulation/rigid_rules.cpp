#include "mpm/simulation/rigid_rules.hpp"

#include <algorithm>

namespace mpm {
namespace {

std::string radial_fault(const SimulationDefinition& definition, const RigidBodyDefinition& body) {
  if (!axisymmetric(definition.geometry) || body.inner_radius > 0.0 || body.velocity[0].is_zero()) return {};
  return "it moves along r, off the axis; only a ring has a radial velocity";
}

std::string free_fault(const SimulationDefinition& definition, const RigidBodyDefinition& body) {
  if (!body.free) return {};
  if (definition.contact.method == ContactMethod::nodes || body.particles) {
    return "free: a free body is met at points of the material's surface; write contact: {method: points}, and leave "
           "out normals: particles";
  }
  if (body.inner_radius > 0.0) return "free: a ring that opens is not rigid; write another shape";
  if (body.free->axes == std::array<bool, 6>{}) return "free: no velocity is free; leave it out";
  if (!body.free->all_free() && body.free->centre != Vec3::Zero()) {
    return "free: the centre of mass is off the body's origin, and a part of its motion is prescribed; put the origin "
           "at the centre of mass, or free all axes";
  }
  return {};
}

// Contact at nodes knows one constant friction a body.
std::string law_fault(const SimulationDefinition& definition, const RigidBodyDefinition& body) {
  if (definition.contact.method != ContactMethod::nodes || body.particles) return {};
  const auto& pairs = definition.contact.pairs;
  const bool named =
      std::any_of(pairs.begin(), pairs.end(), [&](const PairDefinition& pair) { return pair.second == body.name; });
  if (!named && body.friction.static_coefficient < 0.0 && body.friction.adhesion == 0.0) return {};
  return "contact at nodes has no laws of pairs, friction at rest or adhesion; write contact: {method: points}";
}

}  // namespace

std::string rigid_fault(const SimulationDefinition& definition, const RigidBodyDefinition& body) {
  for (const auto rule : {radial_fault, free_fault, law_fault}) {
    if (std::string fault = rule(definition, body); !fault.empty()) return fault;
  }
  return {};
}

}  // namespace mpm
