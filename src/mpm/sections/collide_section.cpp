// `collide` of a rigid body or of a robot's links: whether it meets other bodies and walls.
#include <fmt/format.h>

#include <algorithm>

#include "mpm/math/nearest.hpp"
#include "mpm/rigid/rigid_keys.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {

std::optional<CollideDefinition> read_collide(const Value& value) {
  if (value.is_text()) return value.truth() ? std::optional(CollideDefinition{}) : std::nullopt;
  CollideDefinition collide;
  const Map map = read_keys(value, collide_keys(), collide);
  if (const auto except = map.find("except")) {
    for (const Value& name : except->elements()) collide.except.push_back(name.text());
  }
  return collide;
}

void check_collide(const Map& root, const SimulationDefinition& definition) {
  std::vector<std::string> names;
  for (const RigidBodyDefinition& body : definition.rigid_bodies) names.push_back(body.name);
  for (const RigidBodyDefinition& body : definition.rigid_bodies) {
    if (!body.collide) continue;
    for (const std::string& name : body.collide->except) {
      if (std::find(names.begin(), names.end(), name) != names.end()) continue;
      root.fail(fmt::format("collide of '{}' excepts '{}', and no rigid body is called that; {}", body.name, name,
                            suggest(name, names)));
    }
  }
}

}  // namespace mpm
