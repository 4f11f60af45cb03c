// A scalar of time and place: a constant, or an expression in t [s] and x, y, z [m] parsed once by muParser.
#pragma once

#include <memory>
#include <string>

#include "mpm/math/error.hpp"
#include "mpm/math/geometry.hpp"

namespace mpm {

/// An expression that does not parse or is not finite.
class FunctionError : public Error {
 public:
  using Error::Error;
};

/// Value-semantic and cheap to copy; evaluation allocates nothing and is not thread-safe for one instance.
class Function {
 public:
  /// The constant 0.
  Function() = default;
  /// A constant, in SI.
  Function(double constant) : constant_(constant) {}  // NOLINT: a number is a function
  /// An expression in t, x, y, z with muParser's operators and functions, `pi` and `e`.
  /// `scale` multiplies the result (units of the scene to SI).
  /// @throws FunctionError when it does not parse, or names an unknown variable.
  static Function parse(const std::string& expression, double scale = 1.0);

  /// @throws FunctionError when the value is not finite.
  double operator()(double t, const Vec3& place = Vec3::Zero()) const;
  bool is_constant() const { return expression_ == nullptr; }
  /// The expression, or the constant, as text.
  std::string text() const;

 private:
  struct Expression;
  double constant_ = 0.0;
  double scale_ = 1.0;
  std::shared_ptr<Expression> expression_;
};

}  // namespace mpm
