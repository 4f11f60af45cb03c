#include "mpm/math/function.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <array>
#include <cmath>

namespace mpm {

struct Function::Expression {
  std::string text;
  FunctionUnits units;
  double t = 0.0, x = 0.0, y = 0.0, z = 0.0;  // the parser reads these through pointers
  mu::Parser parser;
};

namespace {

constexpr const char* kVariables = "an expression may use t, x, y, z, pi, e and functions such as sin(...)";

// What people write by habit from other programs, and what it is called here.
std::string hint(const std::string& token) {
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
  return kVariables;
}

}  // namespace

Function Function::parse(const std::string& expression, const FunctionUnits& units) {
  auto parsed = std::make_shared<Expression>();
  parsed->text = expression;
  parsed->units = units;
  mu::Parser& parser = parsed->parser;
  try {
    parser.DefineVar("t", &parsed->t);
    parser.DefineVar("x", &parsed->x);
    parser.DefineVar("y", &parsed->y);
    parser.DefineVar("z", &parsed->z);
    parser.DefineConst("pi", M_PI);
    parser.DefineConst("e", M_E);
    parser.SetExpr(expression);
    parser.Eval();
  } catch (const mu::ParserError& error) {
    if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN && !error.GetToken().empty()) {
      throw FunctionError(
          fmt::format("expression '{}': unknown name '{}'; {}", expression, error.GetToken(), hint(error.GetToken())));
    }
    throw FunctionError(fmt::format("expression '{}' does not parse: {} {}", expression, error.GetMsg(), kVariables));
  }
  if (parser.GetNumResults() != 1) {
    throw FunctionError(fmt::format("expression '{}' has {} values, separated by commas; write one", expression,
                                    parser.GetNumResults()));
  }
  Function function;
  function.expression_ = std::move(parsed);
  return function;
}

double Function::operator()(double t, const Vec3& place) const {
  if (is_constant()) return constant_;
  Expression& parsed = *expression_;
  const FunctionUnits& units = parsed.units;
  parsed.t = t / units.time;
  parsed.x = place.x() / units.length;
  parsed.y = place.y() / units.length;
  parsed.z = place.z() / units.length;
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

std::string Function::text() const { return is_constant() ? fmt::format("{}", constant_) : expression_->text; }

}  // namespace mpm
