// metrics: the scene's own numbers.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "mpm/math/nearest.hpp"
#include "mpm/sections/sections.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace {

const std::vector<std::string> kStatistics = {"mean", "std", "min", "max", "sum"};
constexpr std::array kStatisticKinds = {Statistic::mean, Statistic::std_dev, Statistic::min, Statistic::max,
                                        Statistic::sum};

/// Reads a name that Simulation::body_values() knows.
std::string read_body_value(const Value& value) {
  const std::vector<std::string>& names = Simulation::body_values();
  return names[value.choice(names)];
}

/// The name of a number that some module can report.
std::string read_reported_number(const Value& value, const Scene& scene) {
  const std::string name = value.text();
  std::vector<std::string> known = reported_number_names();
  for (const VolumeDefinition& volume : scene.definition.volumes) {
    for (const auto& [number, unit] : volume_numbers(volume.name)) known.push_back(number);
  }
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    value.fail(fmt::format("no number '{}' of the run; {}", name, suggest(name, known)));
  }
  return name;
}

/// A time within which a metric is looked at.
TimeWindow read_window(const Value& value, const TimeDefinition& time) {
  const Map map(value, {"from", "to"});
  const TimeWindow window{map.at("from").non_negative(kTime), map.at("to").positive(kTime)};
  if (!(window.to > window.from)) {
    value.fail(fmt::format("from {} s to {} s is no time; put `to` after `from`", window.from, window.to));
  }
  if (time.end > 0.0 && window.to > time.end * (1.0 + 1e-9)) {
    value.fail(
        fmt::format("to {:g} s is after the end of the run, {:g} s; end it there or earlier", window.to, time.end));
  }
  if (window.to - window.from < seconds_of(time.sync)) {
    value.fail(fmt::format("it is shorter than time.sync, {:g} s, and values are of sync points; make it longer",
                           seconds_of(time.sync)));
  }
  return window;
}

void read_time_of(const Map& map, const TimeDefinition& time, MetricDefinition& metric) {
  const auto rate = map.find("rate"), over = map.find("over"), at = map.find("at");
  if (rate) metric.rate = read_window(*rate, time);
  if (over) {
    if (rate) over->fail("a rate has a time of its own; leave one of the two out");
    metric.over = read_window(*over, time);
  }
  if (!at) return;
  if (rate) at->fail("a rate has a time of its own; leave one of the two out");
  if (over) at->fail("a mean over a time has one of its own; leave one of the two out");
  metric.at = at->non_negative(kTime);
  if (time.end > 0.0 && *metric.at > time.end * (1.0 + 1e-9))
    at->fail(fmt::format("{:g} s is after the end of the run, {:g} s", *metric.at, time.end));
}

/// An expression of the metrics that are read already, and of the scene's constants.
void read_formula(const Value& value, const Scene& scene, MetricDefinition& metric) {
  const ReadContext& context = value.context();
  metric.formula = value.text();
  for (const auto& [name, number] : context.constants.numbers()) {
    const auto dimension = context.constants.dimension_of(name);
    metric.constants.emplace_back(name, dimension ? number * context.units.factor(*dimension) : number);
  }
  context.constants.used_by(metric.formula);
  NamedConstants names = metric.constants;
  for (const MetricDefinition& before : scene.definition.metrics) {
    if (context.constants.has(before.name))
      value.fail(fmt::format("'{}' is a metric and a constant; give one of them another name", before.name));
    if (meaning_in_expressions(before.name).empty()) names.emplace_back(before.name, 1.0);
  }
  for (const std::string& word : names_in_expression(metric.formula)) {
    for (const MetricDefinition& before : scene.definition.metrics) {
      if (before.name != word || meaning_in_expressions(word).empty()) continue;
      value.fail(fmt::format("'{}' is {} in expressions; give the metric of that name another one", word,
                             meaning_in_expressions(word)));
    }
  }
  try {
    const Function function = Function::parse(metric.formula, {}, FunctionPlaces::present, names);
    if (function.uses_time() || function.uses_place())
      value.fail("a metric has no time and place of its own; use metrics above it, and constants");
  } catch (const FunctionError& error) {
    value.fail(fmt::format("{}; write an expression of the metrics above it, or a map such as {{mean: szz, of: soil}}",
                           error.what()));
  }
}

MetricDefinition read_metric(const Value& value, const Scene& scene) {
  std::vector<std::string> bodies, rigid_bodies;
  for (const BodyDefinition& body : scene.bodies) bodies.push_back(body.name);
  for (const RigidBodyDefinition& body : scene.definition.rigid_bodies) rigid_bodies.push_back(body.name);
  std::vector<std::string> keys = kStatistics;
  keys.insert(keys.end(), {"number", "of", "rate", "over", "at", "in"});
  const Map map(value, keys);
  MetricDefinition metric;
  int statistics = 0;
  const auto of = map.find("of");
  const bool of_rigid = of && std::find(rigid_bodies.begin(), rigid_bodies.end(), of->text()) != rigid_bodies.end();
  for (std::size_t i = 0; i < kStatistics.size(); ++i) {
    if (const auto field = map.find(kStatistics[i])) {
      ++statistics;
      metric.statistic = kStatisticKinds.at(i);
      metric.field = of_rigid ? read_body_value(*field) : read_particle_field(*field);
      if (of_rigid && i > 0) value.fail("a rigid body has one number of a kind; write mean");
    }
  }
  if (const auto number = map.find("number")) {
    ++statistics;
    metric.number = read_reported_number(*number, scene);
    if (of) of->fail("the number is of the whole run; leave it out");
  }
  if (statistics != 1)
    value.fail(fmt::format("has {} statistics; write one of mean, std, min, max, sum or number", statistics));
  if (of) {
    metric.body = of->text();
    if (!of_rigid && std::find(bodies.begin(), bodies.end(), metric.body) == bodies.end()) {
      bodies.insert(bodies.end(), rigid_bodies.begin(), rigid_bodies.end());
      of->fail(fmt::format("no body '{}'; {}", metric.body, suggest(metric.body, bodies)));
    }
    for (const RigidBodyDefinition& body : scene.definition.rigid_bodies) {
      if (body.name == metric.body && metric.field == "mass" && !body.free)
        of->fail(fmt::format("the motion of '{}' is prescribed, so it has no mass; a free body has one", body.name));
    }
  }
  read_time_of(map, scene.definition.time, metric);
  if (const auto region = map.find("in")) {
    if (of_rigid || !metric.number.empty()) region->fail("it is one number for the whole; leave it out");
    metric.region = read_particle_region(*region);
  }
  return metric;
}

}  // namespace

void read_metrics(const Map& root, Scene& scene) {
  const auto section = root.find("metrics");
  if (!section) return;
  if (!section->is_map()) section->fail("write one line for each metric, as in mean_szz: {mean: szz, of: soil}");
  for (const auto& entry : section->node()) {
    const Value value = section->child(entry.second, entry.first.Scalar());
    const std::string name = section->child(entry.first, entry.first.Scalar()).name();
    MetricDefinition metric;
    if (value.is_text()) {
      read_formula(value, scene, metric);
    } else {
      metric = read_metric(value, scene);
    }
    metric.name = name;
    scene.definition.metrics.push_back(std::move(metric));
  }
}

}  // namespace mpm
