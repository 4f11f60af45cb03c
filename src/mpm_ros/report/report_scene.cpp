#include "mpm_ros/report/report_scene.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "mpm/math/lanes.hpp"
#include "mpm/rules/method_text.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

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
    facts.ground_follows = scene.definition.bed.has_value();
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

std::vector<double> particle_masses(const RunInfo& info) {
  mpm::SimulationOptions options;
  options.settle = false;  // moves particles, whose masses stay
  std::vector<double> masses;
  mpm::Simulation(mpm::build(scene_of(info)), options).particle_field("mass", masses);
  return masses;
}

}  // namespace mpm_ros
