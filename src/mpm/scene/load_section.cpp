// loads: what pushes the material beside gravity, tools and boundaries.
#include <fmt/format.h>

#include <algorithm>

#include "mpm/scene/nearest.hpp"
#include "mpm/scene/sections.hpp"

namespace mpm {
namespace {

void read_body_force(const Value& value, Scene& scene) {
  const Map map(value, {"acceleration", "body"}, {{"force", "write acceleration, which is force over mass"}});
  BodyForceDefinition load;
  load.acceleration = map.at("acceleration").functions(kAcceleration, FunctionPlaces::present_and_start);
  if (const auto body = map.find("body"); body && body->text() != "all") {
    load.body = body->text();
    std::vector<std::string> bodies;
    for (const BodyDefinition& other : scene.bodies) bodies.push_back(other.name);
    if (std::find(bodies.begin(), bodies.end(), load.body) == bodies.end()) {
      body->fail(fmt::format("no deformable body '{}'; {}", load.body, suggest(load.body, bodies)));
    }
  }
  scene.definition.body_forces.push_back(std::move(load));
}

}  // namespace

void read_loads(const Map& root, Scene& scene) {
  const auto section = root.find("loads");
  if (!section) return;
  const std::string advice = "use body_force, boundaries or moving rigid_bodies";
  for (const Value& value : section->elements()) {
    const auto [kind, load] =
        only_key(value, {"body_force"}, {{"traction", advice}, {"pressure", advice}, {"particle_force", advice}});
    read_body_force(load, scene);
  }
}

}  // namespace mpm
