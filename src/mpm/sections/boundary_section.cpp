// boundaries: conditions on the faces of the domain, and prescribed velocities on the grid.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mpm/math/constants.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

constexpr double kOnFace = 1e-6;  ///< part of a cell: nodes on the faces of a region belong to it

WallDefinition read_wall(const Value& value) {
  static const std::vector<Later> later = {
      {"velocity", "write it as one of boundaries.conditions"},
      {"periodic", "an axis is periodic, not a face: write x: periodic in place of x_min and x_max"}};
  WallDefinition wall;
  if (value.is_text()) {
    static constexpr std::array kKinds = {WallKind::none, WallKind::fixed, WallKind::slip, WallKind::symmetry,
                                          WallKind::absorbing};
    wall.kind = kKinds.at(value.choice({"none", "fixed", "slip", "symmetry", "absorbing"}, later));
    return wall;
  }
  const auto [key, given] = only_key(value, {"friction", "absorbing"}, later);
  if (key == "absorbing") {
    wall.kind = WallKind::absorbing;
    const Value start = Map(given, {"hold"}).at("hold");
    wall.hold = start.choice({"none", "start"}) == 1;
    return wall;
  }
  wall.kind = WallKind::frictional;
  wall.friction = read_friction(given);
  return wall;
}

/// Checks `x: periodic`.
void check_periodic(const Value& value, int axis, const Scene& scene) {
  constexpr int kMultiple = 8;  // GridLayout::make_periodic
  value.choice({"periodic"});
  if (axisymmetric(scene.definition.geometry) && axis == 0) {
    value.fail("an axisymmetric scene is not periodic along r; leave it out, or make it plane_strain");
  }
  const GridDefinition& grid = scene.definition.grid;
  const double size = grid.max[axis] - grid.min[axis], count = std::round(size / grid.cell[axis]);
  if (std::fmod(count, kMultiple) == 0.0) return;
  const double below = std::floor(count / kMultiple) * kMultiple, above = below + kMultiple;
  const auto choice = [&](double cells) {
    return fmt::format("{:g} cells, max {} = {:.9g} m or cell {:.9g} m", cells, axis_name(axis),
                       grid.min[axis] + cells * grid.cell[axis], size / cells);
  };
  value.fail(fmt::format("the grid has {:g} cells along {}; a periodic axis needs a multiple of {}: {}{}", count,
                         axis_name(axis), kMultiple, below > 0.0 ? choice(below) + ", or " : "", choice(above)));
}

/// Turns a region of space into the surface around it, so that nodes on its faces are included.
void set_region(const Region& region, const Scene& scene, RigidBodyDefinition& body) {
  const GeometryKind geometry = scene.definition.geometry;
  const double margin = kOnFace * scene.definition.smallest_cell();
  const std::vector<int> beside = axes_beside(geometry);
  if (region.kind == Region::Kind::box) {
    Vec3 size = region.box.size() + Vec3::Constant(2.0 * margin);
    body.pose.position = region.box.center();
    for (const int axis : beside) size[axis] = kInfinity, body.pose.position[axis] = 0.0;
    body.surface = make_box(size);
    return;
  }
  body.pose.position = region.center;
  const double radius = region.radius + margin;
  if (region.kind == Region::Kind::cylinder) {
    body.surface = make_cylinder(radius, region.height + 2.0 * margin, region.axis);
  } else if (geometry == GeometryKind::line) {
    body.surface = make_box({2.0 * radius, kInfinity, kInfinity});
  } else if (planar(geometry)) {
    body.surface = make_cylinder(radius, kInfinity, 1);
  } else {
    body.surface = make_sphere(radius);
  }
}

Vec3 read_direction(const Value& value, GeometryKind geometry) {
  const std::vector<int> axes = axes_of(geometry);
  if (value.is_text() && geometry != GeometryKind::line) {
    std::vector<std::string> names;
    for (const int axis : axes) names.emplace_back(axis_name(axis));
    return Vec3::Unit(axes[value.choice(names)]);
  }
  if (value.is_text() && value.text() == "x") return Vec3::UnitX();
  const Vec3 direction = value.vector(kPlain);
  if (!(direction.norm() > 0.0)) value.fail("a direction has a length; write x, or a vector such as [1, 0.5]");
  return direction.normalized();
}

void read_condition(const Value& value, std::size_t index, Scene& scene) {
  const GeometryKind geometry = scene.definition.geometry;
  const Map map(value, {"name", "region", "shape", "pose", "motion", "direction", "velocity"},
                {{"body", "it acts on nodes in a region: write region"}});
  ConditionDefinition condition;
  const auto name = map.find("name");
  condition.region.name = name ? name->name() : std::to_string(index);
  for (const ConditionDefinition& other : scene.definition.conditions) {
    if (other.region.name == condition.region.name) {
      value.fail(fmt::format("a second condition '{}'; give each its own name", other.region.name));
    }
  }
  condition.where = value.where();
  read_region_or_shape(map, scene, condition.region);
  if (!map.find("shape")) read_rigid_motion(map, geometry, condition.region);
  condition.direction = read_direction(map.at("direction"), geometry);
  if (const auto velocity = map.find("velocity")) {
    condition.velocity = velocity->function(kVelocity);
  } else if (!map.find("motion")) {
    value.fail("write velocity, or motion, whose velocity nodes in the region then have");
  }
  scene.definition.conditions.push_back(std::move(condition));
}

}  // namespace

void read_region_or_shape(const Map& map, const Scene& scene, RigidBodyDefinition& body) {
  const auto region = map.find("region");
  if (region.has_value() == map.find("shape").has_value()) {
    map.fail("write region, which is one of a body's shapes, or shape and pose, as of a rigid body: one of them");
  }
  if (!region) {
    read_rigid_shape(map, scene.definition, body);
    return;
  }
  if (const auto pose = map.find("pose")) pose->fail("a region stands where it is written; leave it out, or use shape");
  set_region(read_region(*region, scene.definition.geometry), scene, body);
}

void read_boundaries(const Map& root, Scene& scene) {
  const auto section = root.find("boundaries");
  if (!section) {
    scene.choices.emplace_back("boundaries", "none: a particle that reaches the edge of the grid ends the run");
    return;
  }
  const GeometryKind geometry = scene.definition.geometry;
  const std::vector<int> beside = axes_beside(geometry);
  std::vector<std::string> keys = {"all", "x", "y", "z", "conditions"};
  for (const char* name : kWallNames) keys.emplace_back(name);
  const Map map(*section, keys);
  for (std::size_t i = 0; i < kWallNames.size(); ++i) {
    const int axis = static_cast<int>(i / 2);
    const auto own = map.find(kWallNames[i]);
    if (std::find(beside.begin(), beside.end(), axis) != beside.end()) {
      if (own || map.find(axis_name(axis)))
        (own ? *own : *map.find(axis_name(axis)))
            .fail(fmt::format("{} has no face along {}; leave it out", scene_kind(geometry), axis_name(axis)));
      continue;
    }
    const bool axis_of_symmetry = i == 0 && axisymmetric(geometry) && scene.definition.grid.min.x() == 0.0;
    if (const auto both = map.find(axis_name(axis))) {
      if (own) own->fail(fmt::format("{} is periodic; leave one of the two out", axis_name(axis)));
      if (i % 2 == 0) check_periodic(*both, axis, scene);
      scene.definition.walls[i].kind = WallKind::periodic;
      continue;
    }
    const auto value = own || axis_of_symmetry ? own : map.find("all");
    if (value) scene.definition.walls[i] = read_wall(*value);
  }
  if (const auto conditions = map.find("conditions")) {
    std::size_t index = 0;
    for (const Value& value : conditions->elements()) read_condition(value, index++, scene);
  }
}

}  // namespace mpm
