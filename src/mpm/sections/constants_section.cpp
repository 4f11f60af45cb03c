// constants: numbers with names, for the functions and numbers of the scene.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

const std::string kOperators = "*+-^<>=!&|?";  ///< behind a number that begins an expression; "5 /s" is a quantity

/// Value by the constants above it.
double from_others(const Value& value, const SceneConstants& constants) {
  const std::string text = value.text();
  try {
    const Function function = Function::parse(text, {}, FunctionPlaces::present, constants.numbers());
    if (function.uses_time() || function.uses_place())
      value.fail(
          fmt::format("'{}' depends on time or place, and a constant does not; write it where it is used", text));
    constants.used_by(text);
    return function(0.0);
  } catch (const FunctionError& error) {
    value.fail(
        fmt::format("{}; write a number, with its unit if it has one, such as 0.4 m/s, or an expression of the "
                    "constants above it",
                    error.what()));
  }
}

}  // namespace

void SceneConstants::add(const std::string& name, double number, const std::optional<Dimension>& dimension) {
  numbers_.emplace_back(name, number);
  dimensions_.push_back(dimension);
}

std::optional<Dimension> SceneConstants::dimension_of(const std::string& text) const {
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    if (numbers_[i].first == text) return dimensions_[i];
  }
  return std::nullopt;
}

bool SceneConstants::has(const std::string& name) const {
  return std::any_of(numbers_.begin(), numbers_.end(), [&](const auto& one) { return one.first == name; });
}

bool SceneConstants::used_by(const std::string& expression) const {
  if (empty()) return false;
  bool any = false;
  for (const std::string& name : names_in_expression(expression)) {
    if (!has(name)) continue;
    any = true;
    used_.insert(name);
  }
  return any;
}

std::vector<std::string> SceneConstants::unused() const {
  std::vector<std::string> names;
  for (const auto& [name, number] : numbers_) {
    if (used_.count(name) == 0) names.push_back(name);
  }
  return names;
}

std::string SceneConstants::names() const {
  std::vector<std::string> names;
  for (const auto& [name, number] : numbers_) names.push_back(name);
  return fmt::format("{}", fmt::join(names, ", "));
}

void read_constants(const Value& value, SceneConstants& constants) {
  if (!value.is_map()) value.fail("write one line for each constant, as in slip: 0.2 or v: 0.4 m/s");
  for (const auto& entry : value.node()) {
    const Value key = value.child(entry.first, entry.first.Scalar());
    const std::string name = key.name();
    if (const std::string meaning = meaning_in_expressions(name); !meaning.empty())
      key.fail(fmt::format("'{}' is {} in expressions; choose another name", name, meaning));
    if (entry.second.IsNull()) key.fail("has no value; write a number, with its unit if it has one");
    const Value written = value.child(entry.second, name);
    double number = 0.0;
    std::string unit;
    if (!split_number(written.text(), number, unit)) {
      constants.add(name, from_others(written, constants), std::nullopt);
    } else if (unit.empty()) {
      constants.add(name, written.number(kPlain), std::nullopt);
    } else if (constants.used_by(unit) || kOperators.find(unit[0]) != std::string::npos) {  // "2*slip"
      constants.add(name, from_others(written, constants), std::nullopt);
    } else {
      try {
        const Dimension dimension = parse_unit(unit).dimension;
        constants.add(name, written.number(dimension) / written.context().units.factor(dimension), dimension);
      } catch (const UnitError& error) {
        written.fail(error.what());
      }
    }
  }
}

}  // namespace mpm
