// The runs of a plan: which values each takes, and its scene.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "mpm/advice/feasible.hpp"
#include "mpm/advice/memory.hpp"
#include "mpm/scene/scene_text.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm/sweep/plan.hpp"
#include "mpm/yaml/source.hpp"

namespace mpm::sweep {
namespace {

namespace fs = std::filesystem;

std::string override_of(const Setting& setting) { return setting.path + "=" + setting.value; }

/// Paths under a key `file` from the root on, where they start from the scene's folder.
void from_root(YAML::Node node, const fs::path& folder) {
  if (!node.IsMap() && !node.IsSequence()) return;
  for (const auto& entry : node) {
    if (node.IsMap() && entry.first.Scalar() == "file" && entry.second.IsScalar()) {
      const std::string path = entry.second.Scalar();
      if (path.find("://") == std::string::npos && fs::path(path).is_relative())
        node["file"] = fs::weakly_canonical(fs::absolute(folder / path)).string();
    } else {
      from_root(node.IsMap() ? entry.second : entry, folder);
    }
  }
}

/// A scene's text as it can lie in any folder: its name, which may come from its file, first.
std::string movable(const std::string& text, const std::string& path, const std::string& name) {
  YAML::Node moved(YAML::NodeType::Map);
  moved["name"] = name;
  for (const auto& entry : YAML::Load(text)) moved[entry.first.Scalar()] = entry.second;
  from_root(moved, fs::path(path).parent_path());
  moved["name"] = name;
  return YAML::Dump(moved) + "\n";
}

/// Refuses what a run sets and the scene does not take: "plan.yaml:4: run 17, grid.cell = -1: " and the scene's reason.
[[noreturn]] void refuse(const Plan& plan, int run, const std::vector<Setting>& settings, const std::string& reason) {
  for (const Setting& setting : settings) {
    const std::string place = "--set " + override_of(setting) + ": ";
    if (reason.compare(0, place.size(), place) != 0) continue;
    throw SceneError(fmt::format("{}: run {}, {} = {}: {}", plan.where.at(setting.path), run, setting.path,
                                 setting.value, reason.substr(place.size())));
  }
  throw SceneError(fmt::format("{}: run {}: {}", plan.label, run, reason));
}

}  // namespace

int Plan::runs() const {
  std::size_t runs = 1;
  for (const Axis& axis : axes) runs *= axis.size();
  return static_cast<int>(runs);
}

std::vector<Setting> Plan::settings(int number) const {
  std::size_t rest = static_cast<std::size_t>(number - 1);
  std::vector<Setting> found;
  for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis) {
    const std::vector<Setting>& point = (*axis)[rest % axis->size()];
    rest /= axis->size();
    found.insert(found.end(), point.begin(), point.end());
  }
  std::vector<Setting> ordered;
  for (const std::string& path : parameters) {
    const auto named = [&path](const Setting& setting) { return setting.path == path; };
    ordered.push_back(*std::find_if(found.begin(), found.end(), named));
  }
  return ordered;
}

ResolvedRun resolve(const Plan& plan, int run, const std::function<void(const Scene&)>& check) {
  std::vector<Setting> settings = plan.set;
  const std::vector<Setting> own = plan.settings(run);
  settings.insert(settings.end(), own.begin(), own.end());
  std::vector<std::string> overrides;
  for (const Setting& setting : settings) overrides.push_back(override_of(setting));
  ResolvedRun resolved;
  try {
    Scene& scene = resolved.scene = load_scene(plan.scene, overrides);
    if (!(scene.definition.time.end > 0.0))
      throw SceneError("time.end: the scene has no end; set one in the plan: set: {time.end: 2}");
    check_particles(scene);
    check_steps(scene);
    if (check) check(scene);
    resolved.text = movable(scene.text, scene.path, scene.definition.name);
    resolved.memory =
        expected_particles(scene) * least_bytes_of_particle(scene.definition.method, scene.definition.geometry);
  } catch (const Error& error) {
    refuse(plan, run, settings, error.what());
  }
  return resolved;
}

void check_build(const Scene& scene) {
  SimulationOptions options;
  options.threads = 1;
  options.settle = false;
  // A target has its discretisation chosen, by timing, when it is run.
  if (!scene.target) Simulation simulation(scene, options);
}

std::string base_scene(const Plan& plan) {
  const SceneText scene = read_scene_text(plan.scene);
  const YAML::Node name = YAML::Load(scene.text)["name"];
  return movable(scene.text, scene.path, name ? name.Scalar() : fs::path(scene.path).stem().string());
}

}  // namespace mpm::sweep
