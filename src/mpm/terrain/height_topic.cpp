#include "mpm/terrain/height_topic.hpp"

#include <fmt/format.h>

#include <iterator>

#include "mpm/scene/scene.hpp"
#include "mpm/scene/scene_text.hpp"
#include "mpm/yaml/source.hpp"

namespace mpm {

std::vector<HeightTopic> height_topics(const std::string& name_or_path, const std::vector<std::string>& overrides) {
  const SceneText scene = read_scene_text(name_or_path);
  const Source source(scene.text, scene.path, overrides);
  std::vector<HeightTopic> found;
  for (const char* section : {"bodies", "rigid_bodies"}) {
    const YAML::Node list = source.root()[section];
    if (!list || !list.IsSequence()) continue;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const YAML::Node field = node_at(list[i], "shape.height_field");
      if (!field || !field.IsMap() || !field["topic"] || !field["topic"].IsScalar()) continue;
      HeightTopic topic;
      topic.body = element_name(list, i);
      topic.topic = field["topic"].Scalar();
      topic.path = fmt::format("{}.{}.shape.height_field", section, topic.body);
      for (const char* key : {"x", "y", "scale", "offset", "heights", "file", "table", "cells"}) {
        if (!field[key]) continue;
        throw SceneError(fmt::format("{}: {}.{}: the message on the topic says it; leave it out",
                                     source.where(field[key]), topic.path, key));
      }
      YAML::Node rest = YAML::Clone(field);
      rest.remove("topic");
      topic.rest = YAML::Dump(rest);
      found.push_back(std::move(topic));
    }
  }
  return found;
}

std::string heights_override(const HeightTopic& field, const HeightGrid& map) {
  YAML::Node node = YAML::Load(field.rest);
  if (!node.IsMap()) node = YAML::Node(YAML::NodeType::Map);
  // With units, since those of the scene may be others.
  const auto extent = [&](const char* key, int axis) {
    node[key].push_back(fmt::format("{} m", map.low[axis]));
    node[key].push_back(fmt::format("{} m", map.high[axis]));
  };
  extent("x", 0);
  if (map.rows > 1) extent("y", 1);
  node["scale"] = "1 m";
  std::string text;
  for (int j = 0; j < map.rows; ++j) {
    for (int i = 0; i < map.columns; ++i) {
      fmt::format_to(std::back_inserter(text), "{}{}", i == 0 ? "" : " ",
                     static_cast<float>(map.heights[static_cast<std::size_t>(j) * map.columns + i]));
    }
    text += '\n';
  }
  node["table"] = text;
  node.SetStyle(YAML::EmitterStyle::Flow);
  return fmt::format("{}={}", field.path, YAML::Dump(node));
}

}  // namespace mpm
