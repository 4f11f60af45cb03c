// Files that a scene names.
#include <fmt/format.h>

#include <filesystem>

#include "mpm/rigid/surface.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {

std::string path_from_scene(const Value& value) {
  const std::string path = value.text();
  if (path.find("://") != std::string::npos || std::filesystem::path(path).is_absolute()) return path;
  return (std::filesystem::path(value.context().source->label()).parent_path() / path).string();
}

std::string file_from_scene(const Value& value) {
  const std::string text = value.text(), path = path_from_scene(value);
  std::string file;
  try {
    file = resolve_resource(path);
  } catch (const RigidError& error) {
    value.fail(error.what());
  }
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) return path;
  const std::string folder = std::filesystem::absolute(file, ignored).parent_path().lexically_normal().string();
  value.fail(fmt::format("{}: no such file in {}{}", text, folder,
                         text.rfind('~', 0) == 0
                             ? "; ~ is not the home folder here, write the path out"
                             : "; write a path from the scene's folder, an absolute one, or package://NAME/path"));
}

}  // namespace mpm
