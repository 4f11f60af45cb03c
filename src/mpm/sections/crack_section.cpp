// cracks: explicit cracks, how they move and grow, and how J is taken at their tips.
#include <fmt/format.h>

#include <algorithm>

#include "mpm/crack/chain_shape.hpp"
#include "mpm/crack/crack_keys.hpp"
#include "mpm/rules/feature_rules.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

void read_contour(const Value& value, GeometryKind geometry, ContourDefinition& contour) {
  const Map map = read_keys(value, contour_keys(), contour);
  if (contour.terms == 1 && axisymmetric(geometry)) {
    map.at("terms").fail("about an axis J needs its term of the area; write 2");
  }
  if (const auto form = map.find("form")) {
    if (!axisymmetric(geometry)) form->fail("the two forms differ about an axis alone; leave it out");
    contour.about_axis_by_broberg = form->choice({"broberg", "bergkvist_huong"}) == 0;
  }
}

void read_growth(const Map& map, const TransportDefinition& transport, CracksDefinition& cracks) {
  if (const auto growth = map.find("growth")) cracks.growth = read_growth_rule(*growth, cracks.laws, false);
  if (const auto alternate = map.find("alternate")) cracks.alternate = read_growth_rule(*alternate, cracks.laws, true);
  const auto length = map.find("length"), time_factor = map.find("time_factor");
  if (cracks.length < cracks.time_factor) {
    (length ? *length : *time_factor)
        .fail(fmt::format(
            "steps of {:g} cells, one each time in which a wave crosses {:g} of a cell, keep a tip below the speed of "
            "waves; write a length of at least time_factor",
            cracks.length, cracks.time_factor));
  }
  if (cracks.heating > 0.0 && transport.find(Transported::temperature) == nullptr) {
    map.at("heating").fail("heat needs a temperature; write transport: {temperature: {}}");
  }
}

/// Refuses an alternate rule where no tip has a first one.
void check_alternate(const Map& map, const CracksDefinition& cracks) {
  const auto grows = [](const GrowthRule& rule) { return rule.criterion != FractureCriterion::none; };
  const bool any =
      grows(cracks.growth) || std::any_of(cracks.materials.begin(), cracks.materials.end(),
                                          [&](const FractureConstants& m) { return m.growth && grows(*m.growth); });
  if (any || !grows(cracks.alternate)) return;
  map.at("alternate")
      .fail(
          "stands in for growth, which the scene has not; write growth: {criterion: ...}, or call "
          "this rule growth");
}

void read_settings(const Map& map, GeometryKind geometry, CracksDefinition& cracks, Scene& scene) {
  if (const auto contour = map.find("contour")) read_contour(*contour, geometry, cracks.contour);
  if (const auto split = map.find("split")) {
    if (axisymmetric(geometry) && cracks.split == CracksDefinition::Split::interaction) {
      split->fail("the interaction integral is of planar scenes; write openings");
    }
  } else if (axisymmetric(geometry)) {
    cracks.split = CracksDefinition::Split::openings;
    scene.choices.emplace_back("cracks.split", "openings: about an axis K follows from the faces behind the tip");
  }
  if (const auto ignored = map.find("ignored_by")) {
    for (const Value& name : ignored->elements()) cracks.ignored_by.push_back(read_body(name, scene));
  }
}

void read_laws(const Value& value, CracksDefinition& cracks) {
  if (!value.is_map()) value.fail("write a map of names and laws, such as {glue: {kind: triangular, normal: {...}}}");
  for (const auto& entry : value.node()) {
    const std::string name = value.child(entry.first, entry.first.Scalar()).name();
    TractionLawDefinition law = read_traction_law(value.child(entry.second, name));
    law.name = name;
    cracks.laws.push_back(std::move(law));
  }
}

bool has_tip(const CrackDefinition& crack) {
  return std::count(crack.ends.begin(), crack.ends.end(), CrackEnd::tip) > 0;
}

}  // namespace

Vec2 read_plane_vector(const Value& value, const Dimension& dimension) {
  const Vec3 vector = value.vector(dimension);
  return {vector.x(), vector.z()};
}

bool cracks_may_grow(const Map& root) {
  const auto section = root.find("cracks");
  if (!section || !section->is_map()) return false;
  const auto grows = [](const YAML::Node& rule) {
    if (!rule || !rule.IsMap() || !rule["criterion"] || !rule["criterion"].IsScalar()) return false;
    const std::string criterion = rule["criterion"].Scalar();
    return criterion != "none" && criterion != "0";
  };
  if (grows(section->node()["growth"])) return true;
  const auto materials = root.find("materials");
  if (!materials || !materials->node().IsSequence()) return false;
  for (const YAML::Node& material : materials->node()) {
    if (!material.IsMap() || !material["fracture"] || !material["fracture"].IsMap()) continue;
    if (grows(material["fracture"]["growth"])) return true;
  }
  return false;
}

void read_cracks(const Map& root, Scene& scene) {
  const auto section = root.find("cracks");
  if (!section) return;
  SimulationDefinition& definition = scene.definition;
  if (const auto fault = feature_fault(definition, {}, Feature::cracks)) fail_at(root, *fault);
  CracksDefinition& cracks = definition.cracks;
  const Map map = read_keys(*section, cracks_keys(), cracks);
  if (const auto laws = map.find("traction_laws")) read_laws(*laws, cracks);
  read_settings(map, definition.geometry, cracks, scene);
  read_growth(map, scene.definition.transport, cracks);
  for (const Value& material : root.at("materials").elements()) {
    cracks.materials.push_back(read_fracture_constants(material_map(material, root), cracks));
  }
  check_alternate(map, cracks);
  const double cell = definition.smallest_cell();
  const std::vector<Value> list = map.at("list").elements();
  if (list.empty()) map.at("list").fail("names no crack; write one, or leave out cracks");
  for (const Value& value : list) {
    CrackDefinition crack = read_crack(value, scene);
    for (const CrackDefinition& other : cracks.list) {
      if (other.name == crack.name) value.fail(fmt::format("a second crack '{}'; give each its own name", crack.name));
      const bool apart = !crack.body.empty() && !other.body.empty() && crack.body != other.body;
      if (!apart && (lies_along(crack.points, other.points, cell) || lies_along(other.points, crack.points, cell))) {
        value.fail(fmt::format("'{}' lies along '{}'; make one crack of both, or let them meet at a point", crack.name,
                               other.name));
      }
    }
    check_crack_tips(value, crack, scene);
    cracks.list.push_back(std::move(crack));
  }
  for (const char* rule : {"growth", "alternate"}) {
    const auto written = map.find(rule);
    if (written && std::none_of(cracks.list.begin(), cracks.list.end(), has_tip)) {
      written->fail("no crack has a tip, so none grows; write end: tip for one, or leave it out");
    }
  }
}

}  // namespace mpm
