#include "plan_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace mpm::sweep {
namespace {

constexpr int kMostPoints = 10000;  // points of one grid

/// A number with the unit behind it; the dimension is the scene's to check.
struct Quantity {
  double number = 0.0;
  std::string unit;
};

Quantity read_quantity(const Value& value) {
  Quantity quantity;
  const std::string text = value.text();
  if (!split_number(text, quantity.number, quantity.unit) || !std::isfinite(quantity.number))
    value.fail(fmt::format("'{}' is not a number; write one, with its unit if it has one, such as 0.5 MPa", text));
  if (quantity.unit.empty()) return quantity;
  try {
    parse_unit(quantity.unit);
  } catch (const UnitError& error) {
    value.fail(error.what());
  }
  return quantity;
}

/// A quantity in the unit of another. @throws SceneError when it has another dimension
double number_in(const std::string& unit, const Value& value) {
  const Quantity quantity = read_quantity(value);
  if (quantity.unit == unit) return quantity.number;
  if (quantity.unit.empty() || unit.empty())
    value.fail(fmt::format("'{}' beside a value {}; write both with a unit, or both without", value.text(),
                           unit.empty() ? "without a unit" : "in " + unit));
  const Unit from = parse_unit(quantity.unit), to = parse_unit(unit);
  if (!(from.dimension == to.dimension)) {
    value.fail(fmt::format("'{}' is {}, beside {}; write both in the same unit", value.text(), describe(from.dimension),
                           describe(to.dimension)));
  }
  return quantity.number * (from.factor / to.factor);
}

/// From and to of a grid or a distribution.
struct Range {
  double from = 0.0, to = 0.0;
  std::string unit;
};

Range read_range(const Map& map, bool log) {
  const Quantity first = read_quantity(map.at("from"));
  const Range range{first.number, number_in(first.unit, map.at("to")), first.unit};
  if (!(range.from < range.to)) {
    map.at("to").fail(fmt::format("'{}' is not above '{}'; write the smaller value as from, the larger one as to",
                                  map.at("to").text(), map.at("from").text()));
  }
  if (log && !(range.from > 0.0))
    map.at("from").fail(fmt::format("'{}' is not above 0, where a logarithm begins", map.at("from").text()));
  return range;
}

std::vector<std::string> read_grid(const Value& value) {
  const Map map(value, {"from", "to", "count", "spacing"});
  const auto spacing = map.find("spacing");
  const bool log = spacing && spacing->choice({"linear", "log"}) == 1;
  const Range range = read_range(map, log);
  const int count = map.at("count").integer();
  if (count < 2 || count > kMostPoints)
    map.at("count").fail(fmt::format("{} is not between 2 and {}", count, kMostPoints));
  std::vector<std::string> values;
  for (int i = 0; i < count; ++i) {
    const double part = static_cast<double>(i) / (count - 1);
    double number =
        log ? range.from * std::pow(range.to / range.from, part) : range.from + part * (range.to - range.from);
    if (i == 0) number = range.from;
    if (i + 1 == count) number = range.to;
    values.push_back(quantity_text(rounded(number), range.unit));
  }
  return values;
}

void read_uniform(const Value& value, bool log, ParameterValues& drawn) {
  const Range range = read_range(Map(value, {"from", "to"}), log);
  drawn.distribution.kind = log ? Distribution::Kind::log_uniform : Distribution::Kind::uniform;
  drawn.distribution.from = range.from;
  drawn.distribution.to = range.to;
  drawn.unit = range.unit;
}

void read_normal(const Value& value, ParameterValues& drawn) {
  const Map map(value, {"mean", "deviation", "from", "to"});
  Distribution& normal = drawn.distribution;
  const Quantity mean = read_quantity(map.at("mean"));
  normal.kind = Distribution::Kind::normal;
  normal.mean = mean.number;
  drawn.unit = mean.unit;
  normal.deviation = number_in(mean.unit, map.at("deviation"));
  if (!(normal.deviation > 0.0))
    map.at("deviation").fail(fmt::format("'{}' is not above 0", map.at("deviation").text()));
  if (const auto from = map.find("from")) normal.from = number_in(mean.unit, *from);
  if (const auto to = map.find("to")) normal.to = number_in(mean.unit, *to);
  if (!(normal.from < normal.to)) {
    map.at("to").fail(fmt::format("'{}' is not above '{}'; write the smaller value as from, the larger one as to",
                                  map.at("to").text(), map.at("from").text()));
  }
}

/// Brackets in place of lines, all the way down.
void flow(YAML::Node node) {
  if (!node.IsMap() && !node.IsSequence()) return;
  node.SetStyle(YAML::EmitterStyle::Flow);
  for (const auto& entry : node) flow(node.IsMap() ? entry.second : entry);
}

}  // namespace

std::string quantity_text(double number, const std::string& unit) {
  return unit.empty() ? fmt::format("{}", number) : fmt::format("{} {}", number, unit);
}

std::string one_line(const YAML::Node& node) {
  YAML::Node copy = YAML::Clone(node);
  flow(copy);
  YAML::Emitter emitter;
  emitter << copy;
  std::string text = emitter.c_str();
  std::replace(text.begin(), text.end(), '\n', ' ');  // joins lines of a long list that the emitter breaks
  return text;
}

ParameterValues read_values(const Value& value) {
  ParameterValues found;
  const auto [kind, content] = only_key(value, {"values", "grid", "uniform", "log_uniform", "normal"});
  if (kind == "values") {
    for (const Value& element : content.elements()) {
      if (element.node().IsNull()) element.fail("has no value; write one");
      found.values.push_back(one_line(element.node()));
    }
    if (found.values.empty()) content.fail("is empty; write one value or more");
  } else if (kind == "grid") {
    found.values = read_grid(content);
  } else {
    found.drawn = true;
    if (kind == "normal") {
      read_normal(content, found);
    } else {
      read_uniform(content, kind == "log_uniform", found);
    }
  }
  return found;
}

}  // namespace mpm::sweep
