#include "mpm/math/function.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mpm {

struct Function::Expression {
  std::string text;
  FunctionUnits units;
  FunctionPlaces places;
  bool uses_start = false, uses_place = false;
  double t = 0.0;  // the parser reads these through pointers
  std::array<double, 3> place{}, start{};
  mu::Parser parser;
};

namespace {

constexpr std::array<const char*, 3> kPlace = {"x", "y", "z"};
constexpr std::array<const char*, 3> kStart = {"X", "Y", "Z"};

const char* variables(FunctionPlaces places) {
  return places == FunctionPlaces::present
             ? "an expression may use t, x, y, z, pi, e and functions such as sin(...)"
             : "an expression may use t, x, y, z, X, Y, Z, pi, e and functions such as sin(...)";
}

// Names that people are used to from other programs, and their equivalents here.
std::string hint(const std::string& token, FunctionPlaces places) {
  static constexpr std::array<std::array<const char*, 2>, 8> kHabits = {{{"time", "t"},
                                                                         {"T", "t"},
                                                                         {"X", "x"},
                                                                         {"Y", "y"},
                                                                         {"Z", "z"},
                                                                         {"r", "sqrt(x^2+y^2)"},
                                                                         {"PI", "pi"},
                                                                         {"Pi", "pi"}}};
  for (const auto& [habit, name] : kHabits) {
    if (token == habit) return fmt::format("write '{}'", name);
  }
  return variables(places);
}

}  // namespace

Function Function::parse(const std::string& expression, const FunctionUnits& units, FunctionPlaces places) {
  auto parsed = std::make_shared<Expression>();
  parsed->text = expression;
  parsed->units = units;
  parsed->places = places;
  mu::Parser& parser = parsed->parser;
  try {
    parser.DefineVar("t", &parsed->t);
    for (int k = 0; k < 3; ++k) {
      parser.DefineVar(kPlace[k], &parsed->place[k]);
      if (places == FunctionPlaces::present_and_start) parser.DefineVar(kStart[k], &parsed->start[k]);
    }
    parser.DefineConst("pi", M_PI);
    parser.DefineConst("e", M_E);
    parser.SetExpr(expression);
    parser.Eval();
    const auto uses = [&parser](const char* name) { return parser.GetUsedVar().count(name) > 0; };
    parsed->uses_start = std::any_of(kStart.begin(), kStart.end(), uses);
    parsed->uses_place = parsed->uses_start || std::any_of(kPlace.begin(), kPlace.end(), uses);
  } catch (const mu::ParserError& error) {
    if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN && !error.GetToken().empty()) {
      throw FunctionError(fmt::format("expression '{}': unknown name '{}'; {}", expression, error.GetToken(),
                                      hint(error.GetToken(), places)));
    }
    std::string why = error.GetMsg();
    while (!why.empty() && (why.back() == '.' || why.back() == ' ')) why.pop_back();
    throw FunctionError(fmt::format("expression '{}' does not parse: {}; {}", expression, why, variables(places)));
  }
  if (parser.GetNumResults() != 1) {
    throw FunctionError(fmt::format("expression '{}' has {} values, separated by commas; write one", expression,
                                    parser.GetNumResults()));
  }
  Function function;
  function.expression_ = std::move(parsed);
  return function;
}

double Function::operator()(double t, const Vec3& place, const Vec3& start) const {
  if (is_constant()) return constant_;
  Expression& parsed = *expression_;
  const FunctionUnits& units = parsed.units;
  parsed.t = t / units.time;
  for (int k = 0; k < 3; ++k) {
    parsed.place[k] = place[k] / units.length;
    parsed.start[k] = start[k] / units.length;
  }
  double value = std::nan("");
  try {
    value = parsed.parser.Eval() * units.value;
  } catch (const mu::ParserError& error) {
    throw FunctionError(fmt::format("expression '{}' at t = {} s: {}", parsed.text, t, error.GetMsg()));
  }
  if (!std::isfinite(value)) {
    throw FunctionError(fmt::format(
        "expression '{}' is not finite at t = {} s, place ({}, {}, {}) m; guard it, as in 'x > 0 ? 1/x : 0'",
        parsed.text, t, place.x(), place.y(), place.z()));
  }
  return value;
}

bool Function::uses_start() const { return expression_ != nullptr && expression_->uses_start; }
bool Function::uses_place() const { return expression_ != nullptr && expression_->uses_place; }

Function Function::own_copy() const {
  return is_constant() ? *this : parse(expression_->text, expression_->units, expression_->places);
}

std::string Function::text() const { return is_constant() ? fmt::format("{}", constant_) : expression_->text; }

}  // namespace mpm
