#include "mpm_ros/report/report_scene.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "mpm/math/lanes.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/shape/ring.hpp"
#include "mpm/simulation/method_text.hpp"

namespace mpm_ros {
namespace {

/// The scene; without its rigid bodies where these cannot be read, since their meshes may lie on another machine.
mpm::Scene scene_of(const RunInfo& info) {
  try {
    return mpm::parse_scene(info.scene_text, info.scene_path);
  } catch (const mpm::Error&) {
    try {
      YAML::Node root = YAML::Load(info.scene_text);
      root.remove("rigid_bodies");
      return mpm::parse_scene(YAML::Dump(root), info.scene_path);
    } catch (const YAML::Exception& error) {
      throw mpm::SceneError("the scene that was recorded is not YAML: " + error.msg);
    }
  }
}

std::string text_of(const mpm::SimulationDefinition& definition) {
  const mpm::GeometryKind geometry = definition.geometry;
  return fmt::format("{}, {}, cells of {:g} m, {} particles a cell", mpm::spoken_name(geometry),
                     mpm::method_text(definition.method), definition.grid.cell.x(),
                     mpm::whole_power(definition.method.particles_per_direction, mpm::dimensions(geometry)));
}

}  // namespace

SceneFacts scene_facts(const RunInfo& info) {
  SceneFacts facts;
  if (info.scene_text.empty()) return facts;
  try {
    const mpm::Scene scene = scene_of(info);
    facts.method = text_of(scene.definition);
    facts.axisymmetric = mpm::axisymmetric(scene.definition.geometry);
    facts.gravity = scene.definition.gravity;
    facts.precision = scene.definition.method.precision;
    if (scene.definition.time.end > 0.0) facts.end = scene.definition.time.end;
    const YAML::Node parameters = YAML::Load(info.parameters);  // run_scene --end is there
    if (parameters.IsMap() && parameters["end"]) facts.end = parameters["end"].as<double>();
  } catch (const mpm::Error&) {
    // A scene of another version.
  } catch (const YAML::Exception&) {
    // Text that is no scene at all.
  }
  return facts;
}

std::vector<ParticleMass> particle_masses(const RunInfo& info) {
  const mpm::SimulationDefinition built = mpm::build(scene_of(info));
  const double half = 0.5 * built.grid.cell.x() / built.method.particles_per_direction;
  const bool whole = built.method.axis.domains == mpm::AxisDomains::whole;
  std::vector<ParticleMass> masses;
  for (const mpm::DeformableBody& body : built.bodies) {
    for (const mpm::MaterialDefinition& material : built.materials) {
      if (material.name != body.material) continue;
      const double mass = material.density * body.particle_volume;
      if (!mpm::axisymmetric(built.geometry)) {
        masses.push_back({body.positions.size(), mass});
        continue;
      }
      for (const mpm::Vec3& place : body.positions)
        masses.push_back({1, mass * mpm::ring_length(place.x(), half, whole)});
    }
  }
  return masses;
}

}  // namespace mpm_ros
