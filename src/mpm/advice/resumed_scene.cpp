#include "mpm/advice/resumed_scene.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "mpm/checkpoint/checkpoint.hpp"

namespace mpm {
namespace {

bool says_sync(const YAML::Node& root) {
  const YAML::Node time = root["time"];
  return time && time.IsMap() && time["sync"];
}

/// Without what the state does not depend on.
YAML::Node state_tree(const std::string& text) {
  YAML::Node root = YAML::Load(text);
  for (const char* key : {"output", "metrics"}) root.remove(key);
  return root;
}

void forget_sync(YAML::Node root) {
  if (!says_sync(root)) return;
  root["time"].remove("sync");
  if (root["time"].size() == 0) root.remove("time");
}

std::int64_t sync_of(const std::string& recorded, const std::string& path) {
  return parse_scene(recorded, path).definition.time.sync;
}

}  // namespace

std::string state_difference(const std::string& here, const std::string& there) {
  if (here == there) return {};
  YAML::Node ours = state_tree(here), theirs = state_tree(there);
  if (says_sync(ours) != says_sync(theirs)) {
    forget_sync(ours);
    forget_sync(theirs);
  }
  const std::string a = YAML::Dump(ours), b = YAML::Dump(theirs);
  return a == b ? std::string() : text_difference(a, b);
}

std::string resumed_difference(const Scene& scene, const std::string& recorded) {
  if (scene.text == recorded) return {};
  if (std::string difference = state_difference(scene.text, recorded); !difference.empty()) return difference;
  const std::int64_t here = scene.definition.time.sync, there = sync_of(recorded, scene.path);
  if (here == there) return {};
  return fmt::format("time.sync is {:.9g} s there and {:.9g} s here", seconds_of(there), seconds_of(here));
}

Scene with_recorded_sync(Scene scene, const std::string& recorded) {
  if (scene.text == recorded || !state_difference(scene.text, recorded).empty()) return scene;
  const std::int64_t there = sync_of(recorded, scene.path);
  if (scene.definition.time.sync == there || says_sync(YAML::Load(scene.text))) return scene;
  const double end = scene.definition.time.end;
  Scene synced = parse_scene(scene.text, scene.path, {fmt::format("time.sync={:.9f}", seconds_of(there))});
  synced.definition.time.end = end;
  return synced;
}

}  // namespace mpm
