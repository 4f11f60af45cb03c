// Finds scene files by path, or by the name of a shipped scene.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "mpm/math/build_info.hpp"
#include "mpm/math/input_file.hpp"
#include "mpm/math/nearest.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/scene/scene_text.hpp"

namespace mpm {
namespace {

namespace fs = std::filesystem;

/// Folders of shipped scenes in the order in which they are searched: MPM_ROS_SCENE_PATH (split at ':'), the source
/// tree's, and where the package is installed.
std::vector<fs::path> scene_folders() {
  std::vector<fs::path> folders;
  if (const char* variable = std::getenv("MPM_ROS_SCENE_PATH")) {
    std::istringstream parts(variable);
    for (std::string part; std::getline(parts, part, ':');) {
      if (!part.empty()) folders.emplace_back(part);
    }
  }
  folders.emplace_back(source_folder() + "/config/scenes");
  folders.emplace_back(installed_folder() + "/config/scenes");
  return folders;
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

std::string read_file(const fs::path& path) {
  std::string text;
  if (const std::string refused = read_input(path.string(), text); !refused.empty())
    throw SceneError(fmt::format("{}: {}", path.string(), refused));
  return text;
}

std::string first_comment(const fs::path& path) {
  std::ifstream file;
  std::string line;
  if (!open_input(file, path.string()).empty()) return line;
  std::getline(file, line);
  const std::size_t begin = line.find_first_not_of("# ");
  return line.empty() || line[0] != '#' || begin == std::string::npos ? "" : line.substr(begin);
}

/// Advice on a path at which there is no scene.
std::string advice_for_path(const std::string& path) {
  if (path[0] == '~') return "~ is not the home folder here, write the path out";
  if (path.find("://") != std::string::npos) return "a scene is a path, or the name of a shipped scene";
  if (fs::path(path).is_relative())
    return "write an absolute path (a program that roslaunch starts runs in ~/.ros), or name a shipped scene";
  return "check the path, or name a shipped scene";
}

fs::path find_scene(const std::string& name_or_path) {
  if (is_file(name_or_path)) return name_or_path;
  const bool is_path = name_or_path.find('/') != std::string::npos || fs::path(name_or_path).extension() == ".yaml";
  std::error_code ignored;
  if (is_path && fs::exists(name_or_path, ignored))
    throw SceneError(fmt::format("{}: {}", name_or_path, refused_input(name_or_path)));
  if (is_path) {
    const fs::path folder = fs::absolute(name_or_path, ignored).parent_path().lexically_normal();
    throw SceneError(
        fmt::format("{}: no such scene file in {}; {}", name_or_path, folder.string(), advice_for_path(name_or_path)));
  }
  for (const fs::path& folder : scene_folders()) {
    const fs::path path = folder / (name_or_path + ".yaml");
    if (is_file(path)) return path;
  }
  std::vector<std::string> names;
  for (const auto& [name, line] : shipped_scenes()) names.push_back(name);
  throw SceneError(fmt::format("{}: no shipped scene of that name; {}", name_or_path, suggest(name_or_path, names)));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> shipped_scenes() {
  std::vector<std::pair<std::string, std::string>> scenes;
  for (const fs::path& folder : scene_folders()) {
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
      if (entry.path().extension() != ".yaml") continue;
      const std::string name = entry.path().stem().string();
      const auto same = [&name](const auto& scene) { return scene.first == name; };
      if (std::none_of(scenes.begin(), scenes.end(), same)) scenes.emplace_back(name, first_comment(entry.path()));
    }
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

SceneText read_scene_text(const std::string& name_or_path) {
  const fs::path path = find_scene(name_or_path);
  return {read_file(path), path.string()};
}

Scene load_scene(const std::string& name_or_path, const std::vector<std::string>& overrides) {
  const SceneText scene = read_scene_text(name_or_path);
  return parse_scene(scene.text, scene.path, overrides);
}

}  // namespace mpm
