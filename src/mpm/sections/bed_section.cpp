// terrain: ground that is there only around the bodies that it follows.
#include <fmt/format.h>

#include <algorithm>

#include "mpm/bed/bed_keys.hpp"
#include "mpm/math/nearest.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

/// Adds the rigid bodies of a name: its own, or the links of the robot that is called so.
void add_followed(const Value& value, const SimulationDefinition& definition, BedDefinition& bed) {
  const std::string name = value.text();
  std::vector<std::string> names;
  bool found = false;
  const auto add = [&](const std::string& body) {
    found = true;
    if (std::find(bed.follow.begin(), bed.follow.end(), body) == bed.follow.end()) bed.follow.push_back(body);
  };
  for (const RobotDefinition& robot : definition.robots) {
    names.push_back(robot.name);
    if (robot.name != name) continue;
    if (robot.contacts.empty())
      value.fail(fmt::format("no link of robot '{}' meets the ground; name some in its links", name));
    for (const LinkContact& link : robot.contacts) add(link.body);
  }
  for (const RigidBodyDefinition& body : definition.rigid_bodies) {
    names.push_back(body.name);
    if (body.name == name) add(name);
  }
  if (!found) value.fail(fmt::format("no rigid body or robot '{}'; {}", name, suggest(name, names)));
}

}  // namespace

void read_bed(const Map& root, Scene& scene) {
  const auto section = root.find("terrain");
  if (!section) return;
  SimulationDefinition& definition = scene.definition;
  BedDefinition bed;
  const Map map = read_keys(*section, bed_keys(), bed);
  const Value follow = map.at("follow");
  if (follow.is_list()) {
    for (const Value& one : follow.elements()) add_followed(one, definition, bed);
  } else {
    add_followed(follow, definition, bed);
  }
  if (bed.follow.empty()) follow.fail("it names nobody; name the rigid bodies or robots that the ground follows");
  if (!definition.sleep) map.fail("what ends the ground is asleep; write sleep: {from_start: true} beside it");
  if (definition.geometry != GeometryKind::solid && definition.geometry != GeometryKind::plane_strain)
    map.fail("ground follows bodies in solid and plane_strain scenes alone; write geometry: solid or plane_strain");
  if (scene.bodies.size() != 1) {
    map.fail(
        fmt::format("ground that follows bodies is the only deformable body, and 'bodies' has {}; make the others "
                    "rigid, or leave terrain out",
                    scene.bodies.size()));
  }
  const BodyDefinition& body = scene.bodies.front();
  if (!body.geostatic)
    map.fail(
        fmt::format("ground that is made later is at rest under its weight's stress; write initial: geostatic for "
                    "body '{}'",
                    body.name));
  if (body.region.kind != Region::Kind::box && body.region.kind != Region::Kind::terrain)
    map.fail(fmt::format("body '{}' is no ground; give it the shape box or height_field", body.name));
  if (body.jitter > 0.0)
    map.fail(
        fmt::format("particles off their lattice cannot be made a part at a time; leave out the jitter of body "
                    "'{}'",
                    body.name));
  for (const VolumeDefinition& volume : definition.volumes) {
    if (std::find(bed.follow.begin(), bed.follow.end(), volume.of) != bed.follow.end()) continue;
    map.fail(
        fmt::format("volume '{}' is of no body that the ground follows, and ground that is made in it would count as "
                    "what came in; let it move with one by of",
                    volume.name));
  }
  definition.bed = std::move(bed);
}

}  // namespace mpm
