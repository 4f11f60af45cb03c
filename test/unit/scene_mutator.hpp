// Mutates scene files, as a tree of YAML or as text. The same number gives the same mutation.
#pragma once

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

namespace mpm {

class SceneMutator {
 public:
  explicit SceneMutator(unsigned seed) : random_(seed) {}

  /// Returns `scene` with one or a few changes.
  std::string mutate(const std::string& scene) {
    std::string text = scene;
    int changes = pick(4) < 3 ? 1 : 2 + pick(2);
    for (; changes > 0; --changes) text = pick(8) == 0 ? mutate_text(text) : mutate_tree(text);
    return text;
  }

  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }

 private:
  /// A value and its position: under a key of a map, or in a list.
  struct Spot {
    YAML::Node parent;
    std::string key;
    std::size_t index = 0;
    YAML::Node value() const { return parent.IsMap() ? YAML::Node(parent[key]) : YAML::Node(parent[index]); }
    void set(const YAML::Node& node) {
      if (parent.IsMap()) {
        parent[key] = node;
      } else {
        parent[index] = node;
      }
    }
  };

  template <class T>
  const T& any(const std::vector<T>& list) {
    return list[static_cast<std::size_t>(pick(static_cast<int>(list.size())))];
  }

  /// Returns false when there are too many, or infinitely many (aliases).
  static bool collect(const YAML::Node& node, std::vector<Spot>& spots, int depth = 0) {
    if (depth > 40 || spots.size() > 3000) return false;
    if (node.IsMap()) {
      for (const auto& entry : node) {
        if (!entry.first.IsScalar()) continue;
        spots.push_back({node, entry.first.Scalar(), 0});
        if (!collect(entry.second, spots, depth + 1)) return false;
      }
    } else if (node.IsSequence()) {
      for (std::size_t i = 0; i < node.size(); ++i) {
        spots.push_back({node, "", i});
        if (!collect(node[i], spots, depth + 1)) return false;
      }
    }
    return true;
  }

  std::string number() {
    return any<std::string>({"nan",    ".nan",    "inf",   "-.inf", "1e308",  "-1e308",      "1e-308", "1e400", "-1",
                             "0",      "-0",      "1e-12", "1e12",  "1e30",   "2147483648",  "0x10",   "1_000", "007",
                             "1e",     "--1",     "+5",    "0.1",   "3",      "1e5",         "-0.3",   "1,5",   "½",
                             "1e-300", "9.9e307", "0.5",   "2",     "100000", "4294967296.", "1e18",   "1e9"});
  }

  /// A replacement that a user might write: the same unit or expression with another number.
  std::string other_number(const std::string& text) {
    double value = 0.0;
    int used = 0;
    if (std::sscanf(text.c_str(), "%lf%n", &value, &used) != 1) return text;
    const double factor = any<double>({0.0, 0.1, 0.5, 0.9, 1.1, 2.0, 3.0, 10.0, 100.0, -1.0});
    char number[40];
    std::snprintf(number, sizeof number, "%.9g", factor == 0.0 ? value + 1.0 : factor * value);
    return number + text.substr(static_cast<std::size_t>(used));
  }

  std::string unit() {
    return number() + " " +
           any<std::string>({"mm",
                             "MPa",
                             "deg",
                             "furlong",
                             "kg/m^3",
                             "m/s",
                             "m^-2147483648",
                             "m^99999999999999999999",
                             "N/(m",
                             "1/0",
                             "%",
                             "",
                             "m*m*m*m",
                             "Pa Pa",
                             "µm",
                             "s",
                             "K",
                             "rad/s",
                             "m/s/s",
                             "^",
                             "(((((((((((((((((",
                             "kg^"});
  }

  std::string expression() {
    static const std::string deep(3000, '(');
    return any<std::string>({"sin(t)",
                             "1/0",
                             "sqrt(-1)",
                             "x",
                             "t*x*z",
                             "0/0",
                             "log(0)",
                             "1e308*10",
                             "t<0.1?1:nan",
                             "()",
                             "f(x)",
                             "x=5",
                             "sin(",
                             "t;t",
                             "a",
                             "2^2^2^2^2^2^9",
                             "rnd()",
                             "-2*z",
                             "0.1*sin(20*t)",
                             "\"",
                             "sum()",
                             "min(1,2,3)",
                             "t ? : 1",
                             "1 +",
                             deep,
                             "_pi",
                             "e",
                             "x,y",
                             "10^-300",
                             "$"});
  }

  std::string word() {
    return any<std::string>({"",
                             "soil",
                             "blade",
                             "name",
                             "x",
                             "0",
                             "~",
                             "true",
                             "no",
                             "a.b",
                             "a b",
                             "ä",
                             "\n",
                             "\t",
                             "law",
                             "neo_hookean",
                             "mohr_coulomb",
                             "ideal_gas",
                             "johnson_cook",
                             "newtonian_fluid",
                             "fixed",
                             "stick",
                             "slip",
                             "plane_strain",
                             "plane_stress",
                             "line",
                             "solid",
                             "axisymmetric",
                             "axis",
                             "domains",
                             "functions",
                             "ghosts",
                             "motion",
                             "whole",
                             "planar",
                             "mirror",
                             "mean",
                             "usf",
                             "pic",
                             "all",
                             "../../etc",
                             "/dev/null",
                             "/",
                             "%s%n",
                             "{}",
                             "{0}",
                             "box",
                             "sphere",
                             "mm-g-s",
                             "si",
                             "geostatic",
                             "z",
                             "{:",
                             "\x7f",
                             "\x1b[31m"});
  }

  YAML::Node scalar() {
    switch (pick(6)) {
      case 0:
      case 1:
        return YAML::Node(number());
      case 2:
        return YAML::Node(unit());
      case 3:
        return YAML::Node(expression());
      case 4:
        return YAML::Node(word());
      default:
        return YAML::Node(std::string(static_cast<std::size_t>(1) << pick(17), any<char>({'a', '9', ' ', '.'})));
    }
  }

  YAML::Node nested(int depth) {
    YAML::Node node(number());
    for (int n = 0; n < depth; ++n) {
      YAML::Node outer;
      if (pick(2) == 0) {
        outer.push_back(node);
      } else {
        outer["a"] = node;
      }
      node = outer;
    }
    return node;
  }

  YAML::Node of_another_type(const YAML::Node& value) {
    YAML::Node changed;
    switch (pick(5)) {
      case 0:
        changed.push_back(YAML::Clone(value));
        break;
      case 1:
        changed["box"] = YAML::Clone(value);
        break;
      case 2:
        changed = YAML::Node(YAML::NodeType::Null);
        break;
      case 3:
        changed = YAML::Node(pick(2) == 0 ? YAML::NodeType::Map : YAML::NodeType::Sequence);
        break;
      default:
        if (value.IsSequence() && value.size() > 0) {
          changed = YAML::Clone(value[0]);
        } else if (value.IsMap() && value.size() > 0) {
          changed = YAML::Clone(value.begin()->second);
        } else {
          changed = nested(1 + pick(40));
        }
    }
    return changed;
  }

  /// Mutates the text where the tree cannot represent the change (text that is not YAML, keys that are not words).
  std::string mutate_tree(const std::string& text) {
    try {
      return change_tree(text);
    } catch (const YAML::Exception&) {
      return mutate_text(text);
    }
  }

  std::string change_tree(const std::string& text) {
    const YAML::Node root = YAML::Load(text);
    std::vector<Spot> spots;
    if (text.size() > 100000 || !collect(root, spots) || spots.empty()) return mutate_text(text);
    // Nodes are not assigned to, because yaml-cpp would change the tree.
    const Spot* chosen = &any(spots);
    const int change = pick(16);
    if (change > 3) {  // most values are scalars deep in the tree
      for (int tries = 0; tries < 20 && !chosen->value().IsScalar(); ++tries) chosen = &any(spots);
    }
    Spot spot = *chosen;
    const YAML::Node value = YAML::Clone(spot.value());
    switch (change) {
      case 0:
        if (spot.parent.IsMap()) {
          spot.parent.remove(spot.key);
        } else {
          spot.parent.remove(spot.index);
        }
        break;
      case 1:  // under another name
        if (spot.parent.IsMap()) {
          spot.parent.remove(spot.key);
          std::string key = pick(2) == 0 ? spot.key : word();
          if (key == spot.key && !key.empty())
            key.erase(static_cast<std::size_t>(pick(static_cast<int>(key.size()))), 1);
          spot.parent[key] = value;
        } else {
          spot.parent.push_back(value);
        }
        break;
      case 2: {
        Spot other = any(spots);
        const YAML::Node theirs = YAML::Clone(other.value());
        other.set(value);
        if (spot.parent.IsDefined()) spot.set(theirs);
        break;
      }
      case 3:
        spot.set(of_another_type(value));
        break;
      default:
        spot.set(pick(3) > 0 && spot.value().IsScalar() ? YAML::Node(other_number(spot.value().Scalar())) : scalar());
    }
    return YAML::Dump(root);
  }

  std::string mutate_text(std::string text) {
    const auto place = [&] { return static_cast<std::size_t>(pick(static_cast<int>(text.size()) + 1)); };
    switch (pick(10)) {
      case 0:
        return text.substr(0, place());
      case 1:
        for (int n = 1 + pick(20); n > 0; --n) {
          if (!text.empty()) text[std::min(place(), text.size() - 1)] = static_cast<char>(pick(256));
        }
        return text;
      case 2: {
        std::string noise(static_cast<std::size_t>(1 + pick(50)), ' ');
        for (char& c : noise) c = static_cast<char>(pick(256));
        return text.insert(place(), noise);
      }
      case 3: {
        const std::size_t begin = place();
        return text.erase(begin, static_cast<std::size_t>(pick(30)));
      }
      case 4: {  // a line is repeated or moved
        const std::vector<std::string> lines = split(text);
        if (lines.empty()) return text;
        const std::string line = any(lines);
        const std::size_t at = text.find('\n', place());
        return at == std::string::npos ? text + line + "\n" : text.insert(at + 1, line + "\n");
      }
      case 5: {
        const std::size_t at = text.find(": ", place());
        const std::string anchor = any<std::string>({"&a ", "*a ", "&a *a ", "!!binary ", "!x ", "| ", "> ", "- ", "? ",
                                                     "[", "]", "{", "}", "@", "`", "'", "\"", "# ", "%"});
        return at == std::string::npos ? anchor + text : text.insert(at + 2, anchor);
      }
      case 6: {
        const char* const open = any<const char*>({"[", "{a: ", "- ", "? "});
        std::string deep = "deep: ";
        for (int n = 1 << pick(15); n > 0; --n) deep += open;
        return text + deep + "\n";
      }
      case 7:
        return text +
               any<std::string>({
                   "a: &a [*a]\n",
                   "a: &a {b: *a}\n",
                   "<<: {grid: {cell: 1}}\n",
                   "bodies: &b\n  - *b\n",
                   "a: &a [x, x, x, x, x, x, x, x, x]\nb: &b [*a, *a, *a, *a, *a, *a, *a, *a, *a]\nc: &c [*b, *b, "
                   "*b, *b, *b, *b, *b, *b, *b]\nd: &d [*c, *c, *c, *c, *c, *c, *c, *c, *c]\ne: &e [*d, *d, *d, "
                   "*d, *d, *d, *d, *d, *d]\nf: [*e, *e, *e, *e, *e, *e, *e, *e]\n",
                   "---\nname: second\n",
                   "...\n",
                   "%YAML 9.9\n",
                   "? [1, 2]\n: x\n",
                   "? \n",
                   "*nothing: 1\n",
                   "\"\\u0000\": 1\n",
                   "\"a\\nb\": 1\n",
                   "name: \"a\\nb\"\n",
                   "loads: []\n",
                   "cracks: 1\n",
                   "cracks: {list: [{name: notch, points: [[0, 0.5], [0.5, 0.5]]}]}\n",
               });
      case 8:
        return any<std::string>({"\xEF\xBB\xBF", "\xFF\xFE", "\n\n\n", "--- ", "  ", "\t", "# ", "- "}) + text;
      default: {
        std::vector<std::string> lines = split(text);
        if (lines.empty()) return text;
        std::string& line = lines[static_cast<std::size_t>(pick(static_cast<int>(lines.size())))];
        line.insert(0, static_cast<std::size_t>(1 + pick(4)), ' ');
        std::string joined;
        for (const std::string& part : lines) joined += part + "\n";
        return joined;
      }
    }
  }

  static std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> lines(1);
    for (const char c : text) {
      if (c == '\n') {
        lines.emplace_back();
      } else {
        lines.back() += c;
      }
    }
    return lines;
  }

  std::mt19937 random_;
};

}  // namespace mpm
