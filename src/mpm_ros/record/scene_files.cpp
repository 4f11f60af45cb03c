#include "mpm_ros/record/scene_files.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>

#include "mpm/math/byte_hash.hpp"
#include "mpm/rigid/surface.hpp"

namespace mpm_ros {
namespace {

namespace fs = std::filesystem;

/// The file that a text of the scene names; none when it names none that is there.
std::optional<fs::path> file_of(const std::string& text, const std::string& scene_path) {
  try {
    fs::path path = mpm::resolve_resource(text);
    if (path.is_relative()) path = fs::path(scene_path).parent_path() / path;
    if (fs::is_regular_file(path)) return path;
  } catch (const mpm::Error&) {
    // A package that is not there.
  } catch (const fs::filesystem_error&) {
    // A text that is no path, or a folder that is closed.
  }
  return std::nullopt;
}

std::string hash_of(const fs::path& path) {
  mpm::ByteHash hash;
  std::ifstream file(path, std::ios::binary);
  std::array<char, 65536> bytes;
  while (file.read(bytes.data(), bytes.size()), file.gcount() > 0) {
    hash.add(bytes.data(), static_cast<std::size_t>(file.gcount()));
  }
  return fmt::format("{:016x}", hash.value());
}

struct NamedFile {
  std::string text;  ///< as the scene has it
  fs::path file;
};

void find_files(const YAML::Node& node, const std::string& scene_path, std::vector<NamedFile>& files) {
  if (!node.IsScalar()) {
    for (const auto& entry : node) find_files(node.IsMap() ? entry.second : entry, scene_path, files);
    return;
  }
  const std::string text = node.Scalar();
  const auto known = [&text](const NamedFile& file) { return file.text == text; };
  if (std::any_of(files.begin(), files.end(), known)) return;
  if (const std::optional<fs::path> file = file_of(text, scene_path)) files.push_back({text, *file});
}

std::vector<NamedFile> named_files(const std::string& text, const std::string& scene_path) {
  std::vector<NamedFile> files;
  const YAML::Node scene = YAML::Load(text);
  for (const char* section : {"bodies", "rigid_bodies", "robots", "cracks"}) {
    if (const YAML::Node part = scene[section]) find_files(part, scene_path, files);
  }
  return files;
}

/// The values of an attribute `filename` in a robot's description.
std::vector<std::string> meshes_of(const fs::path& description) {
  constexpr std::string_view kAttribute = "filename=";
  std::ifstream file(description, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  std::vector<std::string> names;
  for (std::size_t at = text.find(kAttribute); at != std::string::npos; at = text.find(kAttribute, at)) {
    at += kAttribute.size();
    if (at == text.size() || (text[at] != '"' && text[at] != '\'')) continue;
    const std::size_t end = text.find(text[at], at + 1);
    if (end == std::string::npos) break;
    names.push_back(text.substr(at + 1, end - at - 1));
    at = end;
  }
  return names;
}

}  // namespace

std::vector<SceneFile> scene_files(const std::string& text, const std::string& scene_path) {
  std::vector<SceneFile> files;
  for (const NamedFile& named : named_files(text, scene_path)) {
    SceneFile file;
    file.path = named.text;
    file.hash = hash_of(named.file);
    files.push_back(file);
  }
  return files;
}

std::vector<std::string> files_read_by(const std::string& text, const std::string& scene_path) {
  std::vector<std::string> files;
  for (const NamedFile& named : named_files(text, scene_path)) {
    files.push_back(named.file.string());
    if (named.file.extension() != ".urdf" && named.file.extension() != ".xml") continue;
    for (const std::string& mesh : meshes_of(named.file)) {
      if (const std::optional<fs::path> file = file_of(mesh, named.file.string())) files.push_back(file->string());
    }
  }
  return files;
}

std::vector<std::string> changed_files(const std::vector<SceneFile>& recorded, const std::string& scene_path) {
  std::vector<std::string> changes;
  for (const SceneFile& file : recorded) {
    const std::optional<fs::path> path = file_of(file.path, scene_path);
    if (!path) {
      changes.push_back(
          fmt::format("{} is not there any more; put it back where the scene {} looks for it", file.path, scene_path));
    } else if (hash_of(*path) != file.hash) {
      changes.push_back(fmt::format("{} has changed since the recording ({})", file.path, path->string()));
    }
  }
  return changes;
}

}  // namespace mpm_ros
