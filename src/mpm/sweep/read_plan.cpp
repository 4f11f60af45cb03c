// From a plan's text to its axes. Errors name file, line and key, as those of a scene do.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "mpm/math/input_file.hpp"
#include "mpm/sweep/plan.hpp"
#include "mpm/yaml/reader.hpp"
#include "plan_values.hpp"

namespace mpm::sweep {
namespace {

namespace fs = std::filesystem;

constexpr int kMostDraws = kMostRuns;

/// True if a path is another, or lies inside it.
bool inside(const std::string& path, const std::string& other) {
  return path == other || (path.size() > other.size() && path.compare(0, other.size() + 1, other + ".") == 0);
}

class PlanReader {
 public:
  PlanReader(const std::string& text, const std::string& label) : source_(text, label, {}, "plan") {
    context_.source = &source_;
    plan_.label = label;
    plan_.text = source_.dump();
  }

  Plan read() {
    const Map root(Value(context_, source_.root(), ""), {"scene", "set", "parameters", "runs", "draws", "record"});
    read_scene(root.at("scene"));
    if (const auto set = root.find("set")) plan_.set = settings_of(*set);
    const auto list = root.find("runs");
    if (list) read_list(*list);
    const auto draws = root.find("draws");
    if (draws) read_draws(*draws);
    const auto parameters = root.find("parameters");
    if (parameters) read_parameters(*parameters, draws);
    if (!list && !parameters) root.fail("changes nothing from run to run; add parameters, or runs");
    if (const auto record = root.find("record")) read_record(*record);
    count(root);
    return std::move(plan_);
  }

 private:
  void read_scene(const Value& value) {
    plan_.scene = value.text();
    const fs::path file(plan_.scene);
    // A name without a slash and an ending is that of a shipped scene, unless a file of that name is beside the plan.
    const fs::path beside = fs::path(plan_.label).parent_path() / file;
    std::error_code ignored;
    if (file.is_relative() &&
        (file.has_parent_path() || file.extension() == ".yaml" || fs::is_regular_file(beside, ignored)))
      plan_.scene = beside.string();
    plan_.where["scene"] = place(value);
  }

  static std::string place(const Value& value) { return value.context().source->where(value.node()); }

  /// Takes a path for itself. @throws SceneError when the plan sets it already
  void take(const Value& at, const std::string& path) {
    for (const auto& [other, where] : taken_) {
      if (!inside(path, other) && !inside(other, path)) continue;
      at.fail(path == other ? fmt::format("is set twice, also at {}; keep one of them", where)
                            : fmt::format("overlaps '{}', set at {}; leave one of them out", other, where));
    }
    taken_.emplace_back(path, place(at));
    plan_.where[path] = place(at);
  }

  /// A map of paths and values. Takes the paths unless `taken`.
  std::vector<Setting> settings_of(const Value& value, bool taken = false) {
    if (!value.is_map()) value.fail("write 'key.path: value' for each key of the scene that is to be set");
    std::vector<Setting> settings;
    for (const auto& entry : value.node()) {
      const std::string& path = entry.first.Scalar();
      const Value child = value.child(entry.second, path);
      if (entry.second.IsNull()) value.child(entry.first, path).fail("has no value; write one");
      if (!taken) take(value.child(entry.first, path), path);
      settings.push_back({path, one_line(child.node())});
    }
    if (settings.empty()) value.fail("sets nothing; write 'key.path: value', or leave it out");
    return settings;
  }

  void read_list(const Value& value) {
    Axis axis;
    for (const Value& element : value.elements()) {
      axis.push_back(settings_of(element, !axis.empty()));
      const auto same_path = [](const Setting& a, const Setting& b) { return a.path == b.path; };
      if (!std::equal(axis.back().begin(), axis.back().end(), axis.front().begin(), axis.front().end(), same_path))
        element.fail("sets other keys than the first of runs, or in another order; set the same ones in each");
    }
    if (axis.empty()) value.fail("is empty; write a run, such as - {grid.cell: 0.02}");
    for (const Setting& setting : axis.front()) plan_.parameters.push_back(setting.path);
    plan_.axes.push_back(std::move(axis));
  }

  void read_draws(const Value& value) {
    const Map map(value, {"count", "seed"});
    draws_ = map.at("count").integer();
    if (draws_ < 1 || draws_ > kMostDraws)
      map.at("count").fail(fmt::format("{} is not between 1 and {}", draws_, kMostDraws));
    const int seed = map.at("seed").integer();
    if (seed < 0) map.at("seed").fail("is less than 0; write a whole number from 0 on");
    seed_ = static_cast<std::uint64_t>(seed);
  }

  void read_parameters(const Value& value, const std::optional<Value>& draws) {
    if (!value.is_map()) value.fail("write 'key.path: {values: [...]}' for each parameter");
    Axis drawn(draws ? static_cast<std::size_t>(draws_) : 0);
    bool any = false;
    for (const auto& entry : value.node()) {
      const std::string& path = entry.first.Scalar();
      if (entry.second.IsNull()) value.child(entry.first, path).fail("has no value; write {values: [...]}");
      const Value child = value.child(entry.second, path);
      const ParameterValues values = read_values(child);
      take(value.child(entry.first, path), path);
      plan_.parameters.push_back(path);
      if (!values.drawn) {
        Axis axis;
        for (const std::string& one : values.values) axis.push_back({{path, one}});
        plan_.axes.push_back(std::move(axis));
        continue;
      }
      if (!draws) child.fail("is drawn; say how often, and from which seed: draws: {count: 100, seed: 1}");
      any = true;
      for (std::size_t i = 0; i < drawn.size(); ++i) {
        const double number = draw(values.distribution, seed_, path, i);
        if (number != number) child.fail("ten thousand draws lie outside from and to; write bounds nearer to the mean");
        drawn[i].push_back({path, quantity_text(number, values.unit)});
      }
    }
    if (draws && !any)
      draws->fail("no parameter is drawn; add one with uniform, log_uniform or normal, or leave it out");
    // First, so that with a larger count the runs there are keep their numbers.
    if (any) plan_.axes.insert(plan_.axes.begin(), std::move(drawn));
  }

  void read_record(const Value& value) {
    for (const Value& element : value.elements()) {
      element.choice({"bag", "csv", "vtk"});
      plan_.record.push_back(element.text());
    }
  }

  void count(const Map& root) const {
    double runs = 1.0;
    for (const Axis& axis : plan_.axes) runs *= static_cast<double>(axis.size());
    if (runs > kMostRuns)
      root.fail(fmt::format("has {:.0f} runs, more than {}; write fewer values, or several plans", runs, kMostRuns));
  }

  const Source source_;
  ReadContext context_;
  Plan plan_;
  std::vector<std::pair<std::string, std::string>> taken_;  // paths, and where they are set
  int draws_ = 0;
  std::uint64_t seed_ = 0;
};

}  // namespace

Plan parse_plan(const std::string& text, const std::string& label) { return PlanReader(text, label).read(); }

Plan read_plan(const std::string& path) {
  std::string text;
  if (const std::string refused = read_input(path, text); !refused.empty())
    throw SceneError(fmt::format("{}: the plan cannot be read: {}", path, refused));
  return parse_plan(text, path);
}

}  // namespace mpm::sweep
