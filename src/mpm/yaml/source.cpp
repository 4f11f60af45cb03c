#include "mpm/yaml/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "mpm/math/nearest.hpp"
#include "mpm/scene/scene.hpp"

namespace mpm {
namespace {

// Aliases (&a, *a) can turn a small text into a huge or endless tree. These limits are far above any real scene.
constexpr int kDeepest = 32;
constexpr int kMostValues = 100000;
constexpr std::size_t kOverrideShown =
    100;  // characters of an override in an error: one can hold a whole map of heights

/// Text of an error on an override.
std::string override_label(const std::string& text) {
  return "--set " + (text.size() > kOverrideShown ? text.substr(0, kOverrideShown) + "..." : text);
}

std::string place(const std::string& label, const YAML::Mark& mark) {
  return mark.is_null() ? label : fmt::format("{}:{}", label, mark.line + 1);
}

// Checks that every key is a word and occurs once, and that the tree has a sensible size.
void check_tree(const YAML::Node& node, const std::string& label, const std::string& path, int depth, int& values) {
  if (depth > kDeepest || ++values > kMostValues) {
    throw SceneError(
        fmt::format("{}: {}: nested too deep or too long; a scene has few levels, write them out without aliases",
                    place(label, node.Mark()), path));
  }
  if (node.IsSequence()) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      check_tree(node[i], label, join_path(path, std::to_string(i)), depth + 1, values);
    }
  }
  if (!node.IsMap()) return;
  std::vector<std::string> seen;
  for (const auto& entry : node) {
    if (!entry.first.IsScalar()) {
      throw SceneError(fmt::format("{}: {}: a key must be a word; write 'key: value'", place(label, entry.first.Mark()),
                                   path.empty() ? "scene" : path));
    }
    const std::string& key = entry.first.Scalar();
    const std::string child = join_path(path, key);
    for (const std::string& other : seen) {
      if (other == key) {
        throw SceneError(
            fmt::format("{}: {}: the key is written twice; keep one of them", place(label, entry.first.Mark()), child));
      }
    }
    seen.push_back(key);
    check_tree(entry.second, label, child, depth + 1, values);
  }
}

// True if `node` is `tree` or lies inside it.
bool holds(const YAML::Node& tree, const YAML::Node& node) {
  if (tree.is(node)) return true;
  if (tree.IsSequence()) {
    for (const auto& element : tree) {
      if (holds(element, node)) return true;
    }
  } else if (tree.IsMap()) {
    for (const auto& entry : tree) {
      if (entry.first.is(node) || holds(entry.second, node)) return true;
    }
  }
  return false;
}

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::vector<std::string> element_names(const YAML::Node& list) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < list.size(); ++i) names.push_back(element_name(list, i));
  return names;
}

// Index of the element that `part` names, or list.size().
std::size_t find_element(const YAML::Node& list, const std::string& part) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (element_name(list, i) == part) return i;
  }
  std::size_t index = 0;
  const auto [stop, error] = std::from_chars(part.data(), part.data() + part.size(), index);
  const bool is_index = error == std::errc() && stop == part.data() + part.size();
  return is_index && index < list.size() ? index : list.size();
}

}  // namespace

std::string join_path(const std::string& path, const std::string& part) {
  return path.empty() ? part : path + "." + part;
}

std::string element_name(const YAML::Node& list, std::size_t index) {
  const YAML::Node element = list[index];
  if (element.IsMap()) {
    const YAML::Node name = element["name"];
    if (name && name.IsScalar() && !name.Scalar().empty()) return name.Scalar();
  }
  return std::to_string(index);
}

YAML::Node key_node(const YAML::Node& map, const std::string& key) {
  for (const auto& entry : map) {
    if (entry.first.Scalar() == key) return entry.first;
  }
  return map;
}

YAML::Node node_at(const YAML::Node& root, const std::string& path) {
  YAML::Node node;
  node.reset(root);
  for (const std::string& part : split(path)) {
    const YAML::Node here = node;
    if (here.IsSequence()) {
      const std::size_t index = find_element(here, part);
      if (index == here.size()) return YAML::Node(YAML::NodeType::Undefined);
      node.reset(here[index]);
    } else {
      if (!here.IsMap() || !here[part]) return YAML::Node(YAML::NodeType::Undefined);
      node.reset(here[part]);
    }
  }
  return node;
}

Source::Source(const std::string& text, std::string label, const std::vector<std::string>& overrides, std::string kind)
    : label_(std::move(label)), kind_(std::move(kind)) {
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() > 1) {
      throw SceneError(fmt::format("{}: the file holds {} YAML documents; a {} is one, remove the lines '---'", label_,
                                   documents.size(), kind_));
    }
    if (!documents.empty()) root_ = documents[0];
  } catch (const YAML::Exception& error) {
    throw SceneError(fmt::format("{}: not YAML: {}; look for a bracket, quote or indentation that does not match",
                                 place(label_, error.mark), error.msg));
  }
  if (!root_.IsMap()) {
    throw SceneError(fmt::format("{}: a {} is a list of 'key: value' lines; found {}", place(label_, root_.Mark()),
                                 kind_, root_.IsSequence() ? "a list" : "no key"));
  }
  int values = 0;
  check_tree(root_, label_, "", 0, values);
  for (const std::string& override_text : overrides) apply(override_text);
}

std::string Source::where(const YAML::Node& node) const {
  // The last override of a value takes effect.
  for (auto it = overrides_.rbegin(); it != overrides_.rend(); ++it) {
    const auto same = [&node](const YAML::Node& created) { return created.is(node); };
    if (holds(it->node, node) || std::any_of(it->created.begin(), it->created.end(), same))
      return override_label(it->text);
  }
  return place(label_, node.Mark());
}

void Source::apply(const std::string& text) {
  const std::string label = override_label(text);
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw SceneError(fmt::format("{}: an override is key.path=value, as in grid.cell=0.02", label));
  }
  const std::string path = text.substr(0, equals);
  YAML::Node value;
  try {
    value = YAML::Load(text.substr(equals + 1));
  } catch (const YAML::Exception& error) {
    throw SceneError(fmt::format("{}: {}: the value is not YAML: {}; quote it", label, path, error.msg));
  }
  int values = 0;
  check_tree(value, label, path, 0, values);

  const std::vector<std::string> parts = split(path);
  YAML::Node node = root_;
  std::string walked;
  std::vector<YAML::Node> created;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string& part = parts[i];
    const bool last = i + 1 == parts.size();
    if (part.empty()) {
      throw SceneError(
          fmt::format("{}: the key path '{}' has an empty part; write it as in grid.cell=0.02", label, path));
    }
    if (node.IsSequence()) {
      const std::size_t index = find_element(node, part);
      if (index == node.size()) {
        throw SceneError(
            fmt::format("{}: {}: no element '{}'; {}", label, walked, part, suggest(part, element_names(node))));
      }
      if (last) node[index] = value;
      node.reset(node[index]);
    } else if (node.IsMap() || node.IsNull()) {
      const bool is_new = !node[part];
      if (is_new && walked == "constants") {
        std::vector<std::string> names;
        for (const auto& entry : node) names.push_back(entry.first.Scalar());
        throw SceneError(
            fmt::format("{}: constants: the scene has no constant '{}'; {}", label, part,
                        names.empty() ? "write it under the scene's 'constants' first" : suggest(part, names)));
      }
      if (last) {
        node[part] = value;
      } else if (is_new) {
        node[part] = YAML::Node(YAML::NodeType::Map);
        created.push_back(node[part]);
      }
      if (is_new) created.push_back(key_node(node, part));
      node.reset(node[part]);
    } else {
      throw SceneError(fmt::format("{}: {}: is one value without keys; set '{}' itself", label, walked, walked));
    }
    walked = join_path(walked, part);
  }
  overrides_.push_back({text, node, std::move(created)});
}

}  // namespace mpm
