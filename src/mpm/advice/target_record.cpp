#include "mpm/advice/target_record.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mpm/advice/resumed_scene.hpp"
#include "mpm/yaml/source.hpp"

namespace mpm {
namespace {

bool same_tree(const YAML::Node& a, const YAML::Node& b) {
  if (a.Type() != b.Type()) return false;
  if (a.IsScalar()) return a.Scalar() == b.Scalar();
  if (a.size() != b.size()) return false;
  if (a.IsSequence()) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (!same_tree(a[i], b[i])) return false;
    }
  } else if (a.IsMap()) {
    for (const auto& entry : a) {
      const YAML::Node other = b[entry.first.Scalar()];
      if (!other || !same_tree(entry.second, other)) return false;
    }
  }
  return true;
}

/// The target of a recorded text, or nothing.
YAML::Node target_of(const std::string& text) {
  try {
    const YAML::Node root = YAML::Load(text);
    return root.IsMap() ? root["target"] : YAML::Node(YAML::NodeType::Undefined);
  } catch (const YAML::Exception&) {
    return YAML::Node(YAML::NodeType::Undefined);
  }
}

/// Returns what is asked, without what was chosen.
YAML::Node asked_of(const YAML::Node& target) {
  YAML::Node copy = YAML::Clone(target);
  for (const char* key : {"chosen", "before", "asked", "expected"}) copy.remove(key);
  return copy;
}

std::string set_key(const std::string& line) { return line.substr(0, line.find('=')); }

/// The value of "key=value"; not defined where it has none, or is not YAML.
YAML::Node set_value(const std::string& line) {
  const std::size_t equals = line.find('=');
  if (equals == std::string::npos) return YAML::Node(YAML::NodeType::Undefined);
  try {
    return YAML::Load(line.substr(equals + 1));
  } catch (const YAML::Exception&) {
    return YAML::Node(YAML::NodeType::Undefined);
  }
}

/// "key=value" as the tree has it, "key" alone where it has none.
std::string line_at(const YAML::Node& root, const std::string& key) {
  const YAML::Node node = node_at(root, key);
  if (!node) return key;
  YAML::Node copy = YAML::Clone(node);
  if (!copy.IsScalar()) copy.SetStyle(YAML::EmitterStyle::Flow);
  return key + "=" + YAML::Dump(copy);
}

bool has_line(const YAML::Node& root, const std::string& line) {
  const YAML::Node there = node_at(root, set_key(line)), value = set_value(line);
  return there && value && same_tree(there, value);
}

/// A list of texts, or nothing.
std::optional<std::vector<std::string>> texts_of(const YAML::Node& target, const char* key) {
  const YAML::Node list = target[key];
  if (!list || !list.IsSequence()) return std::nullopt;
  std::vector<std::string> texts;
  for (const auto& one : list) {
    if (!one.IsScalar()) return std::nullopt;
    texts.push_back(one.Scalar());
  }
  return texts;
}

/// Values of the keys of `lines` in `root`; for those that a choice has changed already, the values before it.
std::vector<std::string> values_before(const YAML::Node& root, const YAML::Node& target,
                                       const std::vector<std::string>& lines) {
  const std::vector<std::string> chosen = texts_of(target, "chosen").value_or(std::vector<std::string>());
  const std::vector<std::string> earlier = texts_of(target, "before").value_or(std::vector<std::string>());
  std::vector<std::string> before;
  for (const std::string& line : lines) {
    const auto same_key = [&](const std::string& other) { return set_key(other) == set_key(line); };
    const auto known = std::find_if(earlier.begin(), earlier.end(), same_key);
    const bool was_chosen = std::any_of(chosen.begin(), chosen.end(), same_key) && known != earlier.end();
    before.push_back(was_chosen ? *known : line_at(root, set_key(line)));
  }
  return before;
}

/// Sets "key=value", or takes "key" away.
void put_back(const YAML::Node& root, const std::string& line) {
  const std::string key = set_key(line);
  const std::size_t dot = key.rfind('.');
  YAML::Node parent;
  parent.reset(dot == std::string::npos ? root : node_at(root, key.substr(0, dot)));
  const std::string last = dot == std::string::npos ? key : key.substr(dot + 1);
  if (!parent || !parent.IsMap()) return;
  if (const YAML::Node value = set_value(line)) {
    parent[last] = value;
  } else {
    parent.remove(last);
  }
}

Scene parsed_with(const Scene& scene, const std::string& text, const std::vector<std::string>& lines) {
  Scene chosen = parse_scene(text, scene.path, lines);
  chosen.definition.time.end = scene.definition.time.end;  // as --end has it
  // Adds what was chosen before the text was written, which is in it as if it had been said.
  for (const auto& choice : scene.choices) {
    const auto same = [&](const auto& other) { return other.first == choice.first; };
    if (std::none_of(chosen.choices.begin(), chosen.choices.end(), same)) chosen.choices.push_back(choice);
  }
  return chosen;
}

}  // namespace

Scene with_chosen(const Scene& scene, const std::vector<std::string>& lines, double expected_pace,
                  double expected_error) {
  YAML::Node root = YAML::Load(scene.text);
  YAML::Node target = root["target"];
  const std::vector<std::string> before = values_before(root, target, lines);
  const YAML::Node asked = asked_of(target);
  target["chosen"] = lines;
  target["before"] = before;
  target["asked"] = asked;
  target["expected"]["real_time"] = fmt::format("{:.4g}", expected_pace);
  target["expected"].remove("force_error");
  if (expected_error > 0.0) target["expected"]["force_error"] = fmt::format("{:.4g}", expected_error);
  return parsed_with(scene, YAML::Dump(root), lines);
}

RecordedChoice with_recorded_choice(const Scene& scene, const std::string& recorded) {
  if (!scene.target || scene.target->chosen) return {scene, {}};
  YAML::Node root = YAML::Load(scene.text);
  const YAML::Node here = target_of(scene.text), there = target_of(recorded);
  if (!there || !there.IsMap()) return {{}, "the run has no target"};
  const auto lines = texts_of(there, "chosen"), before = texts_of(there, "before");
  if (!lines || !before) return {{}, "nothing was chosen for the run's target"};
  if (!same_tree(asked_of(here), asked_of(there))) return {{}, "the run has another target"};
  for (const std::string& line : *before) {
    if (const std::string now = line_at(root, set_key(line)); now != line) {
      const auto said = [](const std::string& text) {
        return text.find('=') == std::string::npos ? " by default" : "";
      };
      return {{},
              fmt::format("what was chosen was chosen from {}{}, and the scene has {}{}", line, said(line), now,
                          said(now))};
    }
  }
  root["target"] = there;
  const std::string text = YAML::Dump(root);
  try {
    const std::string whole = Source(text, scene.path, *lines).dump();
    if (std::string difference = state_difference(whole, recorded); !difference.empty()) return {{}, difference};
    return {parsed_with(scene, text, *lines), {}};
  } catch (const SceneError& error) {
    return {{}, error.what()};
  }
}

std::string text_without_target(const Scene& scene) {
  if (!scene.target) return scene.text;
  YAML::Node root = YAML::Load(scene.text);
  root.remove("target");
  return YAML::Dump(root);
}

void reopen_other_target(const YAML::Node& root) {
  const YAML::Node section = root["target"];
  if (!section || !section.IsMap()) return;
  const YAML::Node asked = section["asked"];
  const auto lines = texts_of(section, "chosen"), before = texts_of(section, "before");
  if (!asked || !lines || !before || same_tree(asked, asked_of(section))) return;
  const auto is_set = [&](const std::string& line) {
    return std::any_of(lines->begin(), lines->end(), [&](const std::string& chosen) {
      return set_key(chosen) == set_key(line) && has_line(root, chosen);
    });
  };
  for (const std::string& line : *before) {
    if (is_set(line)) put_back(root, line);
  }
  YAML::Node target;
  target.reset(section);
  for (const char* key : {"chosen", "before", "asked", "expected"}) target.remove(key);
}

std::string fault_of_record(const YAML::Node& root) {
  const YAML::Node target = root["target"];
  const auto lines = texts_of(target, "chosen"), before = texts_of(target, "before");
  if (!lines) return "write a list of texts";
  const std::string remedy = "replace the target to have it chosen anew, as by --set \"target={real_time: 1}\"";
  for (const std::string& line : *lines) {
    if (has_line(root, line)) continue;
    const std::string now = line_at(root, set_key(line));
    return fmt::format("{} was chosen, and the scene has {}{}; {}", line, now,
                       now.find('=') == std::string::npos ? " by default" : "", remedy);
  }
  if (!before || before->size() != lines->size() || !target["asked"])
    return "a record of a choice has before and asked beside it, as the solver writes them; " + remedy;
  return {};
}

}  // namespace mpm
