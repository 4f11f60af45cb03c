#include "mpm/math/function.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParser.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "mpm/math/constants.hpp"
#include "mpm/math/nearest.hpp"

namespace mpm {

struct Function::Expression {
  std::string text;
  FunctionUnits units;
  FunctionPlaces places;
  NamedConstants constants;
  bool uses_start = false, uses_time = false;
  std::array<bool, 3> uses_place{};
  double t = 0.0;  // the parser reads these through pointers
  std::array<double, 3> place{}, start{};
  mu::Parser parser;
};

namespace {

constexpr std::array<const char*, 3> kPlace = {"x", "y", "z"};
constexpr std::array<const char*, 3> kStart = {"X", "Y", "Z"};

/// Names that may stand in an expression.
std::string variables(FunctionPlaces places, const NamedConstants& constants) {
  std::string text = places == FunctionPlaces::present
                         ? "an expression may use t, x, y, z, pi, e and functions such as sin(...)"
                         : "an expression may use t, x, y, z, X, Y, Z, pi, e and functions such as sin(...)";
  std::vector<std::string> names;
  for (const auto& [name, value] : constants) names.push_back(name);
  if (!names.empty()) text += fmt::format(", and the scene's constants {}", fmt::join(names, ", "));
  return text;
}

/// The parser would assign to a variable, which functions that share it would then read.
void refuse_assignment(const std::string& expression) {
  for (std::size_t i = 0; i < expression.size(); ++i) {
    if (expression[i] != '=') continue;
    const char before = i > 0 ? expression[i - 1] : ' ';
    if (before == '<' || before == '>' || before == '!') continue;
    if (i + 1 < expression.size() && expression[i + 1] == '=') {
      ++i;
      continue;
    }
    throw FunctionError(fmt::format(
        "expression '{}': '=' would assign, which no expression may; write '==' to compare two values", expression));
  }
}

// Names that people are used to from other programs, and their equivalents here.
std::string hint(const std::string& token, FunctionPlaces places, const NamedConstants& constants) {
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
  std::vector<std::string> names;
  for (const auto& [name, value] : constants) names.push_back(name);
  const std::string near = nearest(token, names);
  return (near.empty() ? "" : fmt::format("did you mean '{}'? ", near)) + variables(places, constants);
}

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

}  // namespace

std::string meaning_in_expressions(const std::string& name) {
  if (name == "t") return "the time";
  for (const char* of_place : {"x", "y", "z", "X", "Y", "Z"}) {
    if (name == of_place) return "a place";
  }
  if (name == "pi" || name == "e") return "a number of its own";
  const mu::Parser parser;
  return parser.GetFunDef().count(name) > 0 ? "a function" : "";
}

std::vector<std::string> names_in_expression(const std::string& expression) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < expression.size();) {
    const std::size_t begin = i;
    if (is_letter(expression[i])) {
      while (i < expression.size() && (is_letter(expression[i]) || is_digit(expression[i]))) ++i;
      names.push_back(expression.substr(begin, i - begin));
    } else if (is_digit(expression[i]) || expression[i] == '.') {
      while (i < expression.size() && (is_digit(expression[i]) || expression[i] == '.')) ++i;
      const bool exponent = i + 1 < expression.size() && (expression[i] == 'e' || expression[i] == 'E');
      const bool sign = exponent && (expression[i + 1] == '-' || expression[i + 1] == '+');
      const std::size_t digits = i + (sign ? 2 : 1);
      if (exponent && digits < expression.size() && is_digit(expression[digits])) i = digits;
    } else {
      ++i;
    }
  }
  return names;
}

Function Function::parse(const std::string& expression, const FunctionUnits& units, FunctionPlaces places,
                         const NamedConstants& constants) {
  refuse_assignment(expression);
  auto parsed = std::make_shared<Expression>();
  parsed->text = expression;
  parsed->units = units;
  parsed->places = places;
  parsed->constants = constants;
  mu::Parser& parser = parsed->parser;
  try {
    parser.DefineVar("t", &parsed->t);
    for (int k = 0; k < 3; ++k) {
      parser.DefineVar(kPlace[k], &parsed->place[k]);
      if (places == FunctionPlaces::present_and_start) parser.DefineVar(kStart[k], &parsed->start[k]);
    }
    parser.DefineConst("pi", kPi);
    parser.DefineConst("e", M_E);
    for (const auto& [name, value] : constants) parser.DefineConst(name, value);
    parser.SetExpr(expression);
    parser.Eval();
    const auto uses = [&parser](const char* name) { return parser.GetUsedVar().count(name) > 0; };
    parsed->uses_start = std::any_of(kStart.begin(), kStart.end(), uses);
    for (int k = 0; k < 3; ++k) parsed->uses_place[k] = uses(kPlace[k]) || uses(kStart[k]);
    parsed->uses_time = uses("t");
  } catch (const mu::ParserError& error) {
    if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN && !error.GetToken().empty()) {
      throw FunctionError(fmt::format("expression '{}': unknown name '{}'; {}", expression, error.GetToken(),
                                      hint(error.GetToken(), places, constants)));
    }
    std::string why = error.GetMsg();
    while (!why.empty() && (why.back() == '.' || why.back() == ' ')) why.pop_back();
    throw FunctionError(
        fmt::format("expression '{}' does not parse: {}; {}", expression, why, variables(places, constants)));
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
bool Function::uses_place() const { return uses_place(0) || uses_place(1) || uses_place(2); }
bool Function::uses_place(int axis) const {
  return expression_ != nullptr && expression_->uses_place.at(static_cast<std::size_t>(axis));
}
bool Function::uses_time() const { return expression_ != nullptr && expression_->uses_time; }

Function Function::own_copy() const {
  return is_constant() ? *this
                       : parse(expression_->text, expression_->units, expression_->places, expression_->constants);
}

std::string Function::text() const { return is_constant() ? fmt::format("{}", constant_) : expression_->text; }

}  // namespace mpm
