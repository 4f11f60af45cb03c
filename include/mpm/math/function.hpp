// A scalar function of time and position: a constant, or an expression in t and x, y, z parsed once by muParser.
// Functions that act on moving material may also use X, Y, Z, the position of the material at the start of the run.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mpm/math/error.hpp"
#include "mpm/math/geometry.hpp"

namespace mpm {

/// Thrown for an expression that does not parse or whose value is not finite.
class FunctionError : public Error {
 public:
  using Error::Error;
};

/// Units of an expression, as factors to SI: of its result, of t, and of x, y, z.
struct FunctionUnits {
  double value = 1.0;
  double time = 1.0;    ///< [s]
  double length = 1.0;  ///< [m]
};

/// Positions that an expression may use: the present one (x, y, z) alone, or also the one at the start (X, Y, Z).
enum class FunctionPlaces { present, present_and_start };

/// Numbers that expressions may use by name; each in the units in which expressions are written.
using NamedConstants = std::vector<std::pair<std::string, double>>;

/// Meaning that a name already has in expressions (a variable, a constant or a function), such as "the time"; empty for
/// a name that is free.
std::string meaning_in_expressions(const std::string& name);
/// Names in an expression: words that are no part of a number.
std::vector<std::string> names_in_expression(const std::string& expression);

/// Value-semantic and cheap to copy; evaluation allocates nothing. Copies share one parsed expression: evaluate them
/// from one thread at a time, or give each thread its own_copy().
class Function {
 public:
  /// The constant 0.
  Function() = default;
  /// A constant, in SI.
  Function(double constant) : constant_(constant) {}  // NOLINT: implicit, so that a number can stand for a function
  /// An expression in t, x, y, z with muParser's operators and functions, `pi` and `e`; its variables and its result
  /// are in `units`. `constants`: further names that it may use.
  /// @throws FunctionError when it does not parse, assigns, or names an unknown variable.
  static Function parse(const std::string& expression, const FunctionUnits& units = {},
                        FunctionPlaces places = FunctionPlaces::present, const NamedConstants& constants = {});

  /// The value in SI, at t [s] and place [m]. @throws FunctionError when the value is not finite.
  double operator()(double t, const Vec3& place = Vec3::Zero()) const { return (*this)(t, place, place); }
  /// As above, for material that was at `start` [m] (X, Y, Z) at the start of the run.
  double operator()(double t, const Vec3& place, const Vec3& start) const;
  bool is_constant() const { return expression_ == nullptr; }
  /// The constant 0.
  bool is_zero() const { return is_constant() && constant_ == 0.0; }
  /// True if the value depends on X, Y or Z.
  bool uses_start() const;
  /// True if the value depends on the place at all: x, y, z or X, Y, Z.
  bool uses_place() const;
  /// True if it depends on the place along an axis, 0 to 2.
  bool uses_place(int axis) const;
  /// True if the value depends on t.
  bool uses_time() const;
  /// The same function with a parsed expression of its own.
  Function own_copy() const;
  /// The expression, or the constant in SI, as text.
  std::string text() const;

 private:
  struct Expression;
  double constant_ = 0.0;
  std::shared_ptr<Expression> expression_;
};

}  // namespace mpm
