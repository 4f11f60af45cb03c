// loads: what pushes the material beside gravity, tools and boundaries.
#include <fmt/format.h>

#include <algorithm>

#include "mpm/math/nearest.hpp"
#include "mpm/scene/sections.hpp"

namespace mpm {
namespace {

std::string read_body(const Value& value, const Scene& scene) {
  std::vector<std::string> bodies;
  for (const BodyDefinition& body : scene.bodies) bodies.push_back(body.name);
  std::string name = value.text();
  if (std::find(bodies.begin(), bodies.end(), name) == bodies.end()) {
    value.fail(fmt::format("no deformable body '{}'; {}", name, suggest(name, bodies)));
  }
  return name;
}

LoadSpread read_spread(const Map& map) {
  const auto spread = map.find("spread");
  return spread ? static_cast<LoadSpread>(spread->choice({kSpreadNames.begin(), kSpreadNames.end()}))
                : LoadSpread::domain;
}

void read_body_force(const Value& value, Scene& scene) {
  const Map map(value, {"acceleration", "body", "spread"},
                {{"force", "write acceleration, which is force over mass, or a particle_force"}});
  BodyForceDefinition load;
  load.acceleration = map.at("acceleration").functions(kAcceleration, FunctionPlaces::present_and_start);
  if (const auto body = map.find("body"); body && body->text() != "all") load.body = read_body(*body, scene);
  load.spread = read_spread(map);
  scene.definition.body_forces.push_back(std::move(load));
}

void read_particle_force(const Value& value, Scene& scene) {
  const Map map(value, {"force", "each", "body", "region", "spread"});
  const auto total = map.find("force"), each = map.find("each");
  if (total.has_value() == each.has_value()) {
    value.fail(
        "write force, which all chosen particles carry together, or each, which every one of them carries: one of "
        "them");
  }
  ParticleForceDefinition load;
  load.shared = total.has_value();
  load.force = (total ? total : each)->functions(kForce, FunctionPlaces::present_and_start);
  load.body = read_body(map.at("body"), scene);
  load.spread = read_spread(map);
  LoadRegion chosen;
  if (const auto region = map.find("region")) {
    chosen.region = read_region(*region, scene.definition.geometry);
    chosen.where = region->where();
  }
  scene.definition.particle_forces.push_back(std::move(load));
  scene.load_regions.push_back(std::move(chosen));
}

}  // namespace

void read_loads(const Map& root, Scene& scene) {
  const auto section = root.find("loads");
  if (!section) return;
  const std::string advice = "use particle_force, body_force, boundaries or moving rigid_bodies";
  for (const Value& value : section->elements()) {
    const auto [kind, load] =
        only_key(value, {"body_force", "particle_force"}, {{"traction", advice}, {"pressure", advice}});
    kind == "body_force" ? read_body_force(load, scene) : read_particle_force(load, scene);
  }
}

}  // namespace mpm
