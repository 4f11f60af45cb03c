// The text of a scene as a tree with overrides applied, and the place where each of its values was written.
//
// A path consists of keys; an element of a list stands by its `name`, or by its index when it has none:
// "bodies.soil.material", "bodies.0.material". Overrides and errors use the same spelling.
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

namespace mpm {

class Source {
 public:
  /// `overrides`: "key.path=value", the value in YAML. `kind`: what errors call the text.
  /// @throws SceneError when the text is not YAML, has a key twice, or an override does not fit the tree.
  Source(const std::string& text, std::string label, const std::vector<std::string>& overrides,
         std::string kind = "scene");

  const YAML::Node& root() const { return root_; }
  const std::string& label() const { return label_; }
  const std::string& kind() const { return kind_; }
  /// "file:line" of a value, or the override that set it.
  std::string where(const YAML::Node& node) const;
  /// The tree as YAML, with overrides applied.
  std::string dump() const { return YAML::Dump(root_); }

 private:
  struct Override {
    std::string text;
    YAML::Node node;                  ///< the value that the override set
    std::vector<YAML::Node> created;  ///< keys and maps on the path to the value that did not exist before
  };
  void apply(const std::string& text);

  std::string label_, kind_;
  YAML::Node root_;
  std::vector<Override> overrides_;
};

/// The name of a list's element in paths.
std::string element_name(const YAML::Node& list, std::size_t index);
/// The node of a key itself, for its line; the map when there is no such key.
YAML::Node key_node(const YAML::Node& map, const std::string& key);
/// The node at a path under `root`, not defined where there is none.
YAML::Node node_at(const YAML::Node& root, const std::string& path);
/// `path` extended by one part.
std::string join_path(const std::string& path, const std::string& part);

}  // namespace mpm
