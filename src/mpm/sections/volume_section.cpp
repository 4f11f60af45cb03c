// volumes: closed shapes in which material is counted.
#include <fmt/format.h>

#include <algorithm>

#include "mpm/math/nearest.hpp"
#include "mpm/sections/sections.hpp"
#include "mpm/volumes/volume_keys.hpp"

namespace mpm {
namespace {

VolumeDefinition read_volume(const Value& value, const Scene& scene) {
  VolumeDefinition volume;
  const Map map = read_keys(value, volume_keys(), volume);
  volume.name = map.at("name").name();
  for (const VolumeDefinition& other : scene.definition.volumes) {
    if (other.name == volume.name) value.fail(fmt::format("a second volume '{}'; give each its own name", volume.name));
  }
  if (const auto of = map.find("of")) {
    volume.of = of->text();
    std::vector<std::string> names;
    for (const RigidBodyDefinition& body : scene.definition.rigid_bodies) names.push_back(body.name);
    if (std::find(names.begin(), names.end(), volume.of) == names.end())
      of->fail(fmt::format("no rigid body '{}'; {}", volume.of, suggest(volume.of, names)));
  }
  RigidBodyDefinition shape;
  read_rigid_place(map, scene.definition, shape);
  volume.surface = std::move(shape.surface);
  volume.pose = shape.pose;
  return volume;
}

}  // namespace

void read_volumes(const Map& root, Scene& scene) {
  const auto section = root.find("volumes");
  if (!section) return;
  for (const Value& value : section->elements()) {
    scene.definition.volumes.push_back(read_volume(value, scene));
    if (scene.definition.volumes.size() > kMostVolumes)
      value.fail(fmt::format("more than {} volumes; leave some out", kMostVolumes));
  }
}

}  // namespace mpm
