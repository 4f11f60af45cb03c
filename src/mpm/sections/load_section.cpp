// loads: forces on the material besides gravity, tools and boundaries.
#include <fmt/format.h>

#include <algorithm>

#include "mpm/math/nearest.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

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
  scene.definition.particle_forces.push_back(std::move(load));
  scene.load_regions.push_back(read_load_region(map, scene));
}

/// Reads the face and its particles, which traction and pressure have in common.
TractionDefinition read_face(const Map& map, Scene& scene) {
  TractionDefinition load;
  load.body = read_body(map.at("body"), scene);
  load.face = read_edge(map.at("edge"), scene);
  scene.traction_regions.push_back(read_load_region(map, scene));
  return load;
}

void read_traction(const Value& value, Scene& scene) {
  const Map map(value, {"body", "edge", "region", "traction"});
  TractionDefinition load = read_face(map, scene);
  load.value = map.at("traction").functions(kPressure, FunctionPlaces::present_and_start);
  scene.definition.tractions.push_back(std::move(load));
}

void read_pressure(const Value& value, Scene& scene) {
  const Map map(value, {"body", "edge", "region", "value", "shear"});
  TractionDefinition load = read_face(map, scene);
  load.follows = true;
  load.value[0] = map.at("value").function(kPressure, FunctionPlaces::present_and_start);
  if (const auto shear = map.find("shear")) {
    const int along = dimensions(scene.definition.geometry) - 1;
    if (along == 0) shear->fail("an end of a line has nothing to shear along; leave it out");
    const std::vector<Value> parts = along == 1 ? std::vector<Value>{*shear} : shear->elements();
    if (static_cast<int>(parts.size()) != along) {
      shear->fail(
          fmt::format("found {} components; write two, along the face's two edges in the order of axes", parts.size()));
    }
    for (int k = 0; k < along; ++k) load.value[1 + k] = parts[k].function(kPressure, FunctionPlaces::present_and_start);
  }
  scene.definition.tractions.push_back(std::move(load));
}

}  // namespace

std::string read_body(const Value& value, const Scene& scene) {
  std::vector<std::string> bodies;
  for (const BodyDefinition& body : scene.bodies) bodies.push_back(body.name);
  std::string name = value.text();
  if (std::find(bodies.begin(), bodies.end(), name) == bodies.end()) {
    value.fail(fmt::format("no deformable body '{}'; {}", name, suggest(name, bodies)));
  }
  return name;
}

LoadRegion read_load_region(const Map& map, const Scene& scene) {
  LoadRegion chosen;
  if (const auto region = map.find("region")) {
    chosen.region = read_region(*region, scene.definition.geometry);
    chosen.where = region->where();
  }
  return chosen;
}

int read_edge(const Value& value, const Scene& scene) {
  std::vector<std::string> names;
  std::vector<int> faces;
  for (const int axis : axes_of(scene)) {
    for (const int face : {2 * axis, 2 * axis + 1}) {
      names.emplace_back(kWallNames[face]);
      faces.push_back(face);
    }
  }
  return faces[value.choice(names)];
}

void read_loads(const Map& root, Scene& scene) {
  const auto section = root.find("loads");
  if (!section) return;
  for (const Value& value : section->elements()) {
    const auto [kind, load] = only_key(value, {"body_force", "particle_force", "traction", "pressure"});
    if (kind == "body_force") read_body_force(load, scene);
    if (kind == "particle_force") read_particle_force(load, scene);
    if (kind == "traction") read_traction(load, scene);
    if (kind == "pressure") read_pressure(load, scene);
  }
}

}  // namespace mpm
