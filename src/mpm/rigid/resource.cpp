// package:// and file:// paths without a ROS library: the same places that rospack and catkin search.
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "mpm/math/input_file.hpp"
#include "mpm/rigid/surface.hpp"

namespace mpm {

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> paths_in(const char* variable) {
  std::vector<fs::path> paths;
  const char* value = std::getenv(variable);
  std::istringstream text(value == nullptr ? "" : value);
  for (std::string entry; std::getline(text, entry, ':');) {
    if (!entry.empty()) paths.emplace_back(entry);
  }
  return paths;
}

/// True when the folder's package.xml names the package.
bool holds_package(const fs::path& folder, const std::string& name) {
  std::string manifest;
  if (!read_input((folder / "package.xml").string(), manifest).empty()) return false;
  const std::string open = "<name>", blank = " \t\r\n";
  const std::size_t start = manifest.find(open);
  if (start == std::string::npos) return false;
  const std::size_t first = manifest.find_first_not_of(blank, start + open.size());
  return first != std::string::npos &&
         manifest.substr(first, manifest.find_first_of(blank + "<", first) - first) == name;
}

/// Folders that hold the package, in the order in which they are preferred.
std::vector<fs::path> package_folders(const std::string& name) {
  std::vector<fs::path> found;
  const auto consider = [&](const fs::path& folder) {
    if (holds_package(folder, name)) found.push_back(folder);
  };
  std::error_code ignored;  // an entry that cannot be read holds nothing
  for (const fs::path& entry : paths_in("ROS_PACKAGE_PATH")) {
    consider(entry);
    consider(entry / name);
    for (const auto& folder : fs::directory_iterator(entry, ignored)) {
      if (folder.is_directory(ignored) && folder.path().filename() != name) consider(folder.path());
      if (folder.is_directory(ignored)) consider(folder.path() / name);
    }
  }
  for (const fs::path& prefix : paths_in("CMAKE_PREFIX_PATH")) consider(prefix / "share" / name);
  return found;
}

}  // namespace

std::string resolve_resource(const std::string& uri) {
  const std::string local = "file://";
  if (uri.compare(0, local.size(), local) == 0) {
    if (uri.compare(local.size(), 1, "/") == 0) return uri.substr(local.size());
    throw RigidError(uri +
                     ": file:// takes an absolute path, as in file:///home/me/tool.stl; leave file:// out for a "
                     "path from the scene's folder");
  }
  const std::string scheme = "package://";
  if (uri.compare(0, scheme.size(), scheme) != 0) return uri;
  const std::size_t slash = uri.find('/', scheme.size());
  const std::string name = uri.substr(scheme.size(), slash - scheme.size());
  if (slash == std::string::npos || name.empty() || slash + 1 == uri.size()) {
    throw RigidError(uri + ": write package://NAME/path/in/the/package");
  }
  const std::vector<fs::path> folders = package_folders(name);
  if (folders.empty()) {
    throw RigidError(uri + ": no package '" + name +
                     "' on ROS_PACKAGE_PATH or CMAKE_PREFIX_PATH; source the workspace's setup file");
  }
  // A workspace can show a package twice (its sources, and its built part without them): the one with the file counts.
  const std::string rest = uri.substr(slash + 1);
  std::error_code ignored;
  for (const fs::path& folder : folders) {
    if (fs::exists(folder / rest, ignored)) return (folder / rest).string();
  }
  throw RigidError(uri + ": package '" + name + "' is at " + folders.front().string() + ", but has no file " + rest);
}

}  // namespace mpm
