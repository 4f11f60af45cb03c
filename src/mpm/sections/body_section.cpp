// bodies: deformable bodies with their material, shape and initial state.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "mpm/math/nearest.hpp"
#include "mpm/rules/geometry_rules.hpp"
#include "mpm/sections/section_tables.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

Region read_box(const Value& value, GeometryKind geometry) {
  const Map map(value, {"min", "max"}, {{"size", "write the corners min and max"}});
  Region region;
  region.kind = Region::Kind::box;
  region.box.min = map.at("min").vector(kLength);
  const Value max = map.at("max");
  region.box.max = max.vector(kLength);
  for (const int axis : axes_beside(geometry)) {
    region.box.min[axis] = -std::numeric_limits<double>::infinity();
    region.box.max[axis] = std::numeric_limits<double>::infinity();
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (!(region.box.max[axis] > region.box.min[axis])) {
      max.fail(fmt::format("{} = {} m is not above the box's min ({} m); put max above min", axis_name(axis),
                           region.box.max[axis], region.box.min[axis]));
    }
  }
  if (axisymmetric(geometry) && region.box.min.x() < 0.0) {
    map.at("min").fail(
        fmt::format("material at r = {:g} m; about an axis r is 0 or more: write a radius", region.box.min.x()));
  }
  return region;
}

/// Refuses a centre off the axis: bodies of revolution have theirs on it.
void check_centre(const Value& value, const Region& region) {
  if (region.center.x() == 0.0) return;
  value.fail(
      fmt::format("its centre is {:g} m off the axis, and it is no body of revolution; write [0, z], or a box, "
                  "which is a ring there",
                  region.center.x()));
}

Region read_sphere(const Value& value, GeometryKind geometry) {
  const Map map(value, {"center", "radius"});
  Region region;
  region.kind = Region::Kind::sphere;
  region.center = map.at("center").vector(kLength);
  region.radius = map.at("radius").positive(kLength);
  region.about_axis = axisymmetric(geometry);
  if (region.about_axis) check_centre(map.at("center"), region);
  return region;
}

Region read_cylinder(const Value& value, GeometryKind geometry) {
  const Map map(value, {"center", "radius", "height", "axis"});
  if (geometry != GeometryKind::solid && !axisymmetric(geometry)) {
    value.fail(fmt::format("{} has no cylinder; write sphere, which is {} there, or box", scene_kind(geometry),
                           planar(geometry) ? "a disk" : "an interval"));
  }
  Region region;
  region.kind = Region::Kind::cylinder;
  region.center = map.at("center").vector(kLength);
  region.radius = map.at("radius").positive(kLength);
  region.height = map.at("height").positive(kLength);
  if (const auto axis = map.find("axis")) region.axis = static_cast<int>(axis->choice({"x", "y", "z"}));
  region.about_axis = axisymmetric(geometry);
  if (region.about_axis) {
    check_centre(map.at("center"), region);
    if (region.axis != 2) map.at("axis").fail("an axisymmetric scene turns about z; write z");
  }
  return region;
}

Region read_simple(const std::string& kind, const Value& shape, GeometryKind geometry) {
  if (kind == "box") return read_box(shape, geometry);
  if (kind == "sphere") return read_sphere(shape, geometry);
  return read_cylinder(shape, geometry);
}

Region read_shape(const Value& value, const SimulationDefinition& definition) {
  const std::string advice = "use box, sphere, cylinder or height_field";
  const auto [kind, shape] =
      only_key(value, {"box", "sphere", "cylinder", "height_field"},
               {{"mesh", advice}, {"polygon", advice}, {"capsule", advice}, {"disk", "use sphere"}});
  if (kind == "height_field") return read_terrain(shape, definition);
  return read_simple(kind, shape, definition.geometry);
}

/// Reads rigid bodies by name; whether they exist is checked when the body is filled.
void read_cut_out(const Value& value, BodyDefinition& body) {
  body.cut_out_where = value.where();
  if (value.is_text() && value.text() == "all") {
    body.cut_out_all = true;
    return;
  }
  if (!value.is_list()) value.fail("write all, or a list of rigid bodies, such as [blade]");
  for (const Value& name : value.elements()) body.cut_out.push_back(name.text());
}

}  // namespace

Region read_region(const Value& value, GeometryKind geometry) {
  const std::string advice = "use box, sphere or cylinder";
  const auto [kind, shape] = only_key(
      value, {"box", "sphere", "cylinder"},
      {{"mesh", advice}, {"polygon", advice}, {"capsule", advice}, {"height_field", advice}, {"disk", "use sphere"}});
  return read_simple(kind, shape, geometry);
}

void read_bodies(const Map& root, Scene& scene) {
  const GeometryKind geometry = scene.definition.geometry;
  const Value list = root.at("bodies");
  std::vector<std::string> materials;
  for (const MaterialDefinition& material : scene.definition.materials) materials.push_back(material.name);
  for (const Value& value : list.elements()) {
    BodyDefinition body;
    const Map map = read_keys(value, body_keys(), body);
    body.name = map.at("name").name();
    for (const BodyDefinition& other : scene.bodies) {
      if (other.name == body.name) value.fail(fmt::format("a second body '{}'; give each its own name", body.name));
    }
    const Value material = map.at("material");
    body.material = material.text();
    const auto found = std::find(materials.begin(), materials.end(), body.material);
    if (found == materials.end()) {
      material.fail(fmt::format("no material '{}'; {}", body.material, suggest(body.material, materials)));
    }
    const MaterialDefinition& made_of = scene.definition.materials[found - materials.begin()];
    if (const std::string reason = refused_material(geometry, made_of); !reason.empty()) material.fail(reason);
    const Value shape = map.at("shape");
    body.region = read_shape(shape, scene.definition);
    body.where = shape.where();
    if (const auto seed = map.find("seed")) {
      if (!(body.jitter > 0.0)) seed->fail("is that of jitter, which the body does not have; leave it out");
      body.seed = static_cast<std::uint64_t>(seed->integer(at_least(1.0)));
    }
    if (const auto cut_out = map.find("cut_out")) read_cut_out(*cut_out, body);
    if (const auto initial = map.find("initial")) {
      read_initial(*initial, made_of, scene, body);
    }
    scene.bodies.push_back(std::move(body));
  }
  if (scene.bodies.empty()) list.fail("no body; write at least one that deforms");
}

}  // namespace mpm
