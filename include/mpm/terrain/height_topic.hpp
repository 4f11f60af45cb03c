// Height fields of a scene whose heights come in a message: which they are, and how they get their heights.
//
// The solver library knows no messages. Whoever receives them turns each into an override (as of --set), with which the
// scene is loaded; so the scene's text, which recordings keep, has the heights in it and needs no message any more.
#pragma once

#include <string>
#include <vector>

#include "mpm/rigid/surface.hpp"

namespace mpm {

struct HeightTopic {
  std::string body;   ///< name of the body
  std::string topic;  ///< as written
  std::string path;   ///< "bodies.soil.shape.height_field"
  std::string rest;   ///< the other keys of the height field, YAML
};

/// The height fields that name a topic. Arguments as of load_scene(). @throws SceneError: the scene cannot be read, or
/// a key stands beside the topic that the message determines
std::vector<HeightTopic> height_topics(const std::string& name_or_path, const std::vector<std::string>& overrides);

/// The override that gives a height field these heights; NaN is a hole.
std::string heights_override(const HeightTopic& field, const HeightGrid& map);

}  // namespace mpm
