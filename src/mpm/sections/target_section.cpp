// target: a pace to be kept, or an error of the force on the tool.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/advice/target_half.hpp"
#include "mpm/advice/target_record.hpp"
#include "mpm/pace/target_keys.hpp"
#include "mpm/sections/sections.hpp"
#include "mpm/yaml/source.hpp"

namespace mpm {
namespace {

/// The middle one of a tool's extents in space, the smaller one in a plane; infinite where it has no bounds.
double length_of(const Surface& surface, GeometryKind geometry) {
  const Box bounds = surface.bounds();
  std::vector<double> extents;
  for (const int axis : axes_of(geometry)) extents.push_back(bounds.max[axis] - bounds.min[axis]);
  std::sort(extents.begin(), extents.end());
  const double length = extents[extents.size() == 3 ? 1 : 0];
  return std::isfinite(length) ? length : std::numeric_limits<double>::infinity();
}

void find_extent(const Value& section, Scene& scene) {
  const SimulationDefinition& definition = scene.definition;
  double least = std::numeric_limits<double>::infinity();
  std::string name;
  for (const RigidBodyDefinition& body : definition.rigid_bodies) {
    const double length = length_of(*body.surface, definition.geometry);
    if (length >= least) continue;
    least = length;
    name = body.name;
  }
  if (name.empty()) {
    section.fail(
        "no rigid body has an end along each axis, so cells across the tool cannot be counted; write target.length, "
        "such as 0.1 m");
  }
  scene.target->extent = least;
}

std::vector<std::string> read_keep(const Value& value) {
  std::vector<std::string> keep;
  for (const Value& one : value.elements())
    keep.push_back(pace::discretisation_keys()[one.choice(pace::discretisation_keys())]);
  return keep;
}

void read_chosen(const Map& map, pace::Target& target) {
  const auto chosen = map.find("chosen"), expected = map.find("expected");
  for (const char* key : {"before", "asked", "expected"}) {
    const auto beside = map.find(key);
    if (beside && !chosen) beside->fail("belongs to a recorded choice, target.chosen; leave it out");
  }
  if (!chosen) return;
  target.chosen.emplace();
  for (const Value& line : chosen->elements()) target.chosen->push_back(line.text());
  const std::string fault = fault_of_record(chosen->context().source->root());
  if (!fault.empty()) chosen->fail(fault);
  if (!expected) return;
  const Map of(*expected, {"real_time", "force_error"});
  if (const auto pace = of.find("real_time")) target.expected_pace = pace->positive(kPlain);
  if (const auto error = of.find("force_error")) target.expected_error = error->positive(kPlain);
}

/// Asks nothing of a scene that was halved already.
void read_symmetric(const Value& value, Scene& scene) {
  const std::vector<int> axes = axes_of(scene);
  std::vector<std::string> names;
  for (const int axis : axes) names.emplace_back(axis_name(axis));
  const int axis = axes[value.choice(names)];
  if (axisymmetric(scene.definition.geometry)) value.fail("an axisymmetric scene is a section already; leave it out");
  scene.target->symmetric = axis;
  if (scene.target->chosen) return;
  std::string why = asymmetry(scene, axis);
  const YAML::Node& root = value.context().source->root();
  for (const RigidBodyDefinition& body : scene.definition.rigid_bodies) {
    if (why.empty() && node_at(root, fmt::format("rigid_bodies.{}.shape.height_field", body.name)))
      why = fmt::format("rigid body '{}' is a height field, whose heights may differ on its sides", body.name);
  }
  if (why.empty()) return;
  value.fail(fmt::format("the scene is not its own mirror image across the middle of its grid along {}: {}",
                         axis_name(axis), why));
}

}  // namespace

void read_target(const Map& root, Scene& scene) {
  const auto section = root.find("target");
  if (!section) return;
  pace::Target& target = scene.target.emplace();
  const Map map = read_keys(*section, pace::target_keys(), target);
  const auto real_time = map.find("real_time"), error = map.find("force_error");
  if (real_time && error) {
    error->fail(
        "a target is a pace or an error, not both; leave one out, or replace both with --set \"target={real_time: "
        "1}\"");
  }
  if (!real_time && !error) section->fail("names no target; write real_time: 1 or force_error: 5 %");
  if (scene.definition.rigid_bodies.empty()) {
    section->fail(
        "weighs the force on a tool, and there is no rigid body; leave it out and set grid.cell, method and time.cfl "
        "by hand");
  }
  const auto method = root.find("method");
  if (method && method->is_map()) {
    const YAML::Node chosen = method->node()["auto"];
    for (const char* budget : {"error", "cost"}) {
      if (chosen && chosen.IsMap() && chosen[budget]) {
        section->fail(
            fmt::format("method.auto.{} is another budget; leave one of them out (method: auto without a "
                        "budget may stand beside a target)",
                        budget));
      }
    }
  }
  if (const auto keep = map.find("keep")) target.keep = read_keep(*keep);
  if (!target.length) find_extent(*section, scene);
  read_chosen(map, target);
  if (const auto symmetric = map.find("symmetric")) read_symmetric(*symmetric, scene);
}

}  // namespace mpm
