// bodies.<name>.initial: the initial state of a body, checked against its material.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/material/initial_state.hpp"
#include "mpm/rules/geometry_rules.hpp"
#include "mpm/rules/section_keys.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

const std::array<const char*, 6> kStressComponents = {"xx", "yy", "zz", "yz", "xz", "xy"};

/// Components of stress that a scene may give; the others are zero, or follow from these.
std::vector<std::string> free_components(GeometryKind geometry) {
  switch (geometry) {
    case GeometryKind::line:
      return {"xx"};
    case GeometryKind::plane_strain:
      return {"xx", "yy", "zz", "xz"};
    case GeometryKind::plane_stress:
      return {"xx", "zz", "xz"};
    case GeometryKind::axisymmetric:
      return {"xx", "yy", "zz", "xz"};
    case GeometryKind::solid:
      break;
  }
  return {kStressComponents.begin(), kStressComponents.end()};
}

const char* stress_example(GeometryKind geometry) {
  switch (geometry) {
    case GeometryKind::line:
      return "{xx: -1 kPa}; yy and zz follow, for a line has no strain across it";
    case GeometryKind::plane_strain:
      return "{xx: -1 kPa, zz: -2 kPa}; yy, left out, follows from plane strain";
    case GeometryKind::plane_stress:
      return "{xx: -1 kPa, zz: -2 kPa}; yy is 0";
    case GeometryKind::axisymmetric:
      return "{xx: -1 kPa, yy: -1 kPa, zz: -2 kPa}: radial, hoop and axial; those left out are 0";
    case GeometryKind::solid:
      break;
  }
  return "{xx: -1 kPa, yy: -1 kPa, zz: -2 kPa}; those left out are 0";
}

void read_stress(const Value& value, GeometryKind geometry, BodyDefinition& body) {
  if (!value.is_map()) value.fail(fmt::format("name its components, as in {}", stress_example(geometry)));
  const std::vector<std::string> names = free_components(geometry);
  const Map map(value, names);
  std::array<Function, 6> stress;
  for (std::size_t k = 0; k < kStressComponents.size(); ++k) {
    if (std::find(names.begin(), names.end(), kStressComponents[k]) == names.end()) continue;
    if (const auto component = map.find(kStressComponents[k])) stress[k] = component->function(kPressure);
  }
  body.stress = stress;
  body.yy_follows = geometry == GeometryKind::plane_strain && !map.find("yy");
}

void read_geostatic(const Value& value, const MaterialDefinition& material, Scene& scene, BodyDefinition& body) {
  if (const std::string reason = refused_geostatic(scene.definition.geometry); !reason.empty()) value.fail(reason);
  GeostaticDefinition geostatic;
  if (!value.is_text()) read_keys(value, geostatic_keys(), geostatic);
  const Vec3& gravity = scene.definition.gravity;
  if (!(gravity.norm() > 0.0)) value.fail("needs gravity; write it, such as gravity: [0, 0, -9.81]");
  if (gravity.cwiseAbs().maxCoeff() < (1.0 - 1e-12) * gravity.norm()) {
    value.fail("needs gravity along an axis; turn the scene, or let the body settle in the run");
  }
  const std::optional<double> own = pressure_at_rest(material.law);
  if (!own) {
    value.fail(fmt::format("material '{}' ({}) is not held by its weight; leave it out, and give temperature or stress",
                           material.name, law_name(material.law)));
  }
  if (!geostatic.k0) {
    scene.choices.emplace_back(
        value.path() + ".k0",
        fmt::format("{:.4g}: of {} at rest, raised to what its yield surface carries", *own, law_name(material.law)));
  }
  body.geostatic = geostatic;
}

}  // namespace

void read_initial(const Value& value, const MaterialDefinition& material, Scene& scene, BodyDefinition& body) {
  body.initial_where = value.where();
  if (value.is_text()) {
    value.choice({"geostatic"});
    read_geostatic(value, material, scene, body);
    return;
  }
  const Map map(value, {"velocity", "stress", "temperature", "geostatic"},
                {{"concentration", "write it under transport.concentration.initial, by the body's name"},
                 {"pore_pressure", "write it under transport.pore_pressure.initial, by the body's name"}});
  if (const auto velocity = map.find("velocity")) body.velocity = velocity->functions(kVelocity);
  if (const auto stress = map.find("stress")) {
    read_stress(*stress, scene.definition.geometry, body);
  }
  if (const auto temperature = map.find("temperature")) {
    if (InitialStates(material, scene.definition.geometry).temperature_index() < 0) {
      temperature->fail(
          fmt::format("material '{}' ({}) has no temperature; leave it out", material.name, law_name(material.law)));
    }
    body.temperature = temperature->function(kTemperature);
  }
  if (const auto geostatic = map.find("geostatic")) {
    if (geostatic->is_text()) geostatic->fail("write initial: geostatic, or its keys k0 and residual");
    for (const char* other : {"velocity", "stress", "temperature"}) {
      if (const auto both = map.find(other))
        both->fail("a geostatic start is at rest under its weight; leave this out");
    }
    read_geostatic(*geostatic, material, scene, body);
  }
}

}  // namespace mpm
