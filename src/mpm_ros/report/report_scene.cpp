#include "mpm_ros/report/report_scene.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "mpm/math/lanes.hpp"
#include "mpm/scene/scene.hpp"

namespace mpm_ros {
namespace {

/// The scene; without its rigid bodies where these cannot be read, since their meshes may lie on another machine.
mpm::Scene scene_of(const RunInfo& info) {
  try {
    return mpm::parse_scene(info.scene_text, info.scene_path);
  } catch (const mpm::Error&) {
    YAML::Node root = YAML::Load(info.scene_text);
    root.remove("rigid_bodies");
    return mpm::parse_scene(YAML::Dump(root), info.scene_path);
  }
}

std::string method_text(const mpm::SimulationDefinition& definition) {
  const mpm::MethodDefinition& method = definition.method;
  const std::string transfer =
      method.transfer.flip == 1.0
          ? "FLIP"
          : (method.transfer.flip == 0.0 ? "PIC" : fmt::format("FLIP {:g}", method.transfer.flip));
  const int a_cell = mpm::whole_power(method.particles_per_direction, mpm::dimensions(definition.geometry));
  return fmt::format("{}, uGIMP, {}, {}{}, {} precision, cells of {:g} m, {} particles a cell",
                     mpm::spoken_name(definition.geometry), method.update == mpm::UpdateScheme::usavg ? "USAVG" : "USF",
                     transfer, method.damping > 0.0 ? fmt::format(", grid damping {:g}/s", method.damping) : "",
                     mpm::precision_name(method.precision), definition.grid.cell.x(), a_cell);
}

}  // namespace

SceneFacts scene_facts(const RunInfo& info) {
  SceneFacts facts;
  if (info.scene_text.empty()) return facts;
  try {
    const mpm::Scene scene = scene_of(info);
    facts.method = method_text(scene.definition);
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
  std::vector<ParticleMass> masses;
  for (const mpm::DeformableBody& body : built.bodies) {
    for (const mpm::MaterialDefinition& material : built.materials) {
      if (material.name != body.material) continue;
      masses.push_back({body.positions.size(), material.density * body.particle_volume});
    }
  }
  return masses;
}

}  // namespace mpm_ros
