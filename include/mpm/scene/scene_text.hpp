// The text of a scene's file.
#pragma once

#include <string>

namespace mpm {

struct SceneText {
  std::string text;
  std::string path;  ///< path of the file
};

/// Finds a scene as load_scene() does, and reads it. @throws SceneError
SceneText read_scene_text(const std::string& name_or_path);

}  // namespace mpm
