// bodies.<name>.initial: what a body starts with, checked against its material.
#include <fmt/format.h>

#include <cmath>

#include "mpm/material/initial_state.hpp"
#include "mpm/scene/sections.hpp"

namespace mpm {
namespace {

const std::array<const char*, 6> kComponents = {"xx", "yy", "zz", "yz", "xz", "xy"};

void read_stress(const Value& value, bool planar, BodyDefinition& body) {
  if (!value.is_map()) {
    value.fail(planar ? "name its components, as in {xx: -1 kPa, zz: -2 kPa}; yy, left out, follows from plane strain"
                      : "name its components, as in {xx: -1 kPa, yy: -1 kPa, zz: -2 kPa}; those left out are 0");
  }
  const Map map(value, planar ? std::vector<std::string>{"xx", "yy", "zz", "xz"}
                              : std::vector<std::string>(kComponents.begin(), kComponents.end()));
  std::array<Function, 6> stress;
  for (std::size_t k = 0; k < kComponents.size(); ++k) {
    if (planar && (k == 3 || k == 5)) continue;
    if (const auto component = map.find(kComponents[k])) stress[k] = component->function(kPressure);
  }
  body.stress = stress;
  body.yy_follows = planar && !map.find("yy");
}

void read_geostatic(const Value& value, const MaterialDefinition& material, Scene& scene, BodyDefinition& body) {
  GeostaticDefinition geostatic;
  if (!value.is_text()) {
    const Map map(value, {"k0", "residual"},
                  {{"surface", "the weight above each particle is summed over the particles"}});
    if (const auto k0 = map.find("k0")) geostatic.k0 = k0->non_negative(kPlain);
    if (const auto residual = map.find("residual")) geostatic.residual = residual->positive(kPlain);
  }
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
  const Map map(
      value, {"velocity", "stress", "temperature", "geostatic"},
      {{"concentration", "a run has no diffusion"}, {"pore_pressure", "a run has no pore pressure; write stress"}});
  if (const auto velocity = map.find("velocity")) body.velocity = velocity->functions(kVelocity);
  if (const auto stress = map.find("stress")) {
    read_stress(*stress, scene.definition.geometry == GeometryKind::plane_strain, body);
  }
  if (const auto temperature = map.find("temperature")) {
    if (InitialStates(material, false).temperature_index() < 0) {
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
