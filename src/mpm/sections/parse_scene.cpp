// From a scene's text to a Scene: the order in which its sections are read.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "mpm/advice/implicit_choice.hpp"
#include "mpm/advice/target_record.hpp"
#include "mpm/rules/feature_rules.hpp"
#include "mpm/rules/geometry_rules.hpp"
#include "mpm/rules/implicit_rules.hpp"
#include "mpm/rules/method_rules.hpp"
#include "mpm/rules/method_text.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

void read_geometry(const Map& root, ReadContext& context, Scene& scene) {
  SimulationDefinition& definition = scene.definition;
  if (const auto geometry = root.find("geometry")) {
    const std::vector<std::string> names(kGeometryNames.begin(), kGeometryNames.end());
    definition.geometry = static_cast<GeometryKind>(geometry->choice(names));
  } else {
    scene.choices.emplace_back("geometry", "solid: three dimensions unless the scene says otherwise");
  }
  context.geometry = definition.geometry;
  if (const auto thickness = root.find("thickness")) {
    if (!planar(definition.geometry)) thickness->fail("only a planar scene has a thickness; leave it out");
    definition.thickness = thickness->positive(kLength);
  } else if (planar(definition.geometry)) {
    definition.thickness = context.units.factor(kLength);
    scene.choices.emplace_back("thickness", fmt::format("{} m: one unit of length along y", definition.thickness));
  }
  if (const auto area = root.find("area")) {
    if (definition.geometry != GeometryKind::line) area->fail("only a line has an area across it; leave it out");
    definition.area = area->positive(kArea);
  } else if (definition.geometry == GeometryKind::line) {
    definition.area = context.units.factor(kArea);
    scene.choices.emplace_back("area", fmt::format("{} m^2: one unit of length squared, across x", definition.area));
  }
}

/// The scene's text with the chosen method in place of `auto`, so that a record runs again to the same bits, even if
/// later measurements would lead to another choice.
std::string with_method(const YAML::Node& tree, const MethodDefinition& chosen) {
  YAML::Node root = YAML::Clone(tree);
  if (!root["method"] || !root["method"].IsMap()) root["method"] = YAML::Node(YAML::NodeType::Map);
  YAML::Node method = root["method"];
  method.remove("auto");
  method["shape"] = shape_name(chosen.shape);
  method["update"] = update_name(chosen.update);
  const Transfer& transfer = chosen.transfer;
  const std::string kind = kTransferNames[static_cast<int>(transfer.kind)];
  YAML::Node value(kind);
  if (transfer.kind == TransferKind::flip && transfer.flip != 1.0) {
    value = YAML::Node(YAML::NodeType::Map);
    value[kind] = fmt::format("{}", transfer.flip);
    if (transfer.mixed != 1) value["xpic"] = transfer.mixed;
    if (transfer.every != 1) value["every"] = transfer.every;
  } else if (transfer.kind == TransferKind::xpic || transfer.kind == TransferKind::fmpm) {
    value = YAML::Node(YAML::NodeType::Map);
    value[kind] = transfer.order;
  }
  method["transfer"] = value;
  return YAML::Dump(root);
}

/// Notes whether stresses are averaged, where the scene does not say it.
void tell_of_averages(Scene& scene) {
  const SimulationDefinition& definition = scene.definition;
  const bool flows = std::any_of(definition.bodies.begin(), definition.bodies.end(),
                                 [&](const DeformableBody& body) { return shares_stress(definition, body); });
  if (!flows || definition.method.average_stress) return;
  if (averages_stress(definition.method, definition.geometry)) {
    scene.choices.emplace_back("method.average_stress",
                               "true: what flows has one stress in a cell, against too much force on tools");
  }
}

}  // namespace

void fail_at(const Map& root, const MethodFault& fault) {
  const std::string section = fault.key.substr(0, fault.key.find('.'));
  const std::string rest = section == fault.key ? fault.text : fault.key.substr(section.size() + 1) + ": " + fault.text;
  if (const auto named = root.find(section)) named->fail(rest);
  root.fail(fault.key + ": " + fault.text);
}

Scene parse_scene(const std::string& text, const std::string& label, const std::vector<std::string>& overrides) {
  const Source source(text, label, overrides);
  reopen_other_target(source.root());
  ReadContext context;
  context.source = &source;
  const Value top(context, source.root(), "");
  const Map root(top, {"name",    "units",      "constants", "geometry",  "thickness", "area",         "grid",
                       "time",    "method",     "gravity",   "materials", "bodies",    "rigid_bodies", "robots",
                       "contact", "boundaries", "loads",     "transport", "sleep",     "cracks",       "output",
                       "metrics", "target",     "volumes",   "terrain"});
  Scene scene;
  scene.path = label;
  SimulationDefinition& definition = scene.definition;
  if (const auto name = root.find("name")) {
    definition.name = name->text();
  } else {
    definition.name = std::filesystem::path(label).stem().string();
  }
  if (const auto units = root.find("units")) {
    context.units = read_units(*units);
  }
  if (const auto constants = root.find("constants")) read_constants(*constants, context.constants);
  read_geometry(root, context, scene);
  read_grid(root, scene);
  read_materials(root, scene);
  const std::optional<AutoMethod> asked = read_method(root, scene);
  if (const auto gravity = root.find("gravity")) {
    definition.gravity = gravity->vector(kAcceleration);
  } else {
    scene.choices.emplace_back("gravity", "none: the scene names none");
  }
  read_bodies(root, scene);
  const FrictionLaw friction = read_rigid_bodies(root, scene);
  read_robots(root, friction, scene);
  check_collide(root, scene.definition);
  read_contact_pairs(root, scene);
  read_boundaries(root, scene);
  read_loads(root, scene);
  read_time_and_output(root, scene);
  if (definition.method.update == UpdateScheme::implicit && !definition.time.step) take_implicit_step(scene);
  read_sleep(root, scene);
  read_transport(root, scene);
  read_cracks(root, scene);
  read_volumes(root, scene);
  read_bed(root, scene);
  const bool takes_implicit = asked && choose_implicit(*asked, root, scene);
  tell_of_averages(scene);
  read_metrics(root, scene);
  read_target(root, scene);
  for (const std::string& name : context.constants.unused()) {
    definition.warnings.push_back(
        fmt::format("constants.{}: nothing in the scene uses it; use it, or leave it out", name));
  }
  if (const auto fault = axis_fault(definition)) root.at(fault->key).fail(fault->text);
  if (const auto fault = feature_fault(definition)) fail_at(root, *fault);
  if (const auto fault = implicit_fault(definition)) fail_at(root, *fault);
  if (asked && !takes_implicit) choose_method(*asked, load_method_costs(), scene);
  scene.text = asked ? with_method(source.root(), definition.method) : source.dump();
  return scene;
}

}  // namespace mpm
