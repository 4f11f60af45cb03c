// output.terrain: maps of the ground's height over time.
#include <fmt/format.h>

#include <algorithm>

#include "mpm/math/nearest.hpp"
#include "mpm/scene/scene_parts.hpp"
#include "mpm/sections/section_tables.hpp"
#include "mpm/sections/sections.hpp"
#include "mpm/terrain/ground_map.hpp"

namespace mpm {
namespace {

/// Reads the window's size, a length along each axis that the map has.
Vec2 read_window_size(const Value& value, const SimulationDefinition& definition) {
  const bool in_plane = planar(definition.geometry);
  const std::vector<Value> lengths = in_plane && value.is_text() ? std::vector<Value>{value} : value.elements();
  if (lengths.size() != (in_plane ? 1 : 2)) value.fail(in_plane ? "write a length along x" : "write lengths [x, y]");
  Vec2 size = Vec2::Zero();
  for (std::size_t axis = 0; axis < lengths.size(); ++axis) {
    const double room = definition.grid.max[axis] - definition.grid.min[axis];
    size[axis] = lengths[axis].positive(kLength);
    if (size[axis] <= room * (1.0 + 1e-9)) continue;
    lengths[axis].fail(fmt::format("the window is longer along {} than the domain, {:.6g} m; write that or less",
                                   axis_name(static_cast<int>(axis)), room));
  }
  return size;
}

void read_window(const Value& value, const Scene& scene, GroundOutput& ground) {
  const Map map(value, {"of", "size"});
  const Value of = map.at("of");
  ground.follows = of.text();
  std::vector<std::string> names;
  for (const RigidBodyDefinition& body : scene.definition.rigid_bodies) names.push_back(body.name);
  if (std::find(names.begin(), names.end(), ground.follows) == names.end())
    of.fail(fmt::format("no rigid body '{}'; {}", ground.follows, suggest(ground.follows, names)));
  ground.window = read_window_size(map.at("size"), scene.definition);
}

}  // namespace

void read_ground_output(const Value& value, Scene& scene) {
  const SimulationDefinition& definition = scene.definition;
  if (axisymmetric(definition.geometry)) value.fail("a body of revolution has no map of heights; leave it out");
  if (definition.geometry == GeometryKind::line) value.fail("a line has no heights; leave it out");
  GroundOutput ground;
  ground.period = scene.output.period;
  ground.resolution = ground_resolution(definition.grid);
  const Map map = read_keys(value, ground_keys(), ground);
  if (const auto period = map.find("period")) ground.period = read_sync_periods(*period, scene);
  try {
    ground_raster(definition.grid, definition.geometry, ground.resolution);
  } catch (const Error& error) {
    map.find("resolution").value_or(value).fail(error.what());
  }
  if (const auto of = map.find("of")) ground.of = read_body(*of, scene);
  if (const auto window = map.find("window")) read_window(*window, scene, ground);
  scene.output.ground = std::move(ground);
}

}  // namespace mpm
