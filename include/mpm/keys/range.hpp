// The values that a number of a scene may have.
#pragma once

#include <string>

#include "mpm/keys/dimension.hpp"
#include "mpm/math/constants.hpp"

namespace mpm {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// An interval in SI, with or without its ends; without a lower end it is that of all numbers.
struct Range {
  double least = -kInfinity;
  double most = kInfinity;
  bool with_least = true, with_most = true;
  bool or_none = false;  ///< true if scenes may write `none`, which is infinity: without a limit
  double unset = kNan;   ///< value of definitions that stands for a key that is left out; NaN: none does

  /// Returns what is wrong with a value of a scene, such as "is not greater than 0"; empty for one in the interval.
  std::string fault(double value, const Dimension& dimension) const;
  /// Words that follow a noun: "above 0", "from 0 to below 90 deg"; empty for all numbers.
  std::string words(const Dimension& dimension) const;
  /// The same for the pages, with a sign where one suffices: "> 0".
  std::string signs(const Dimension& dimension) const;
};

inline constexpr Range kAny{};
inline constexpr Range kPositive{0.0, kInfinity, false};
inline constexpr Range kNotNegative{0.0};
inline constexpr Range kPart{0.0, 1.0};  ///< part of a whole
constexpr Range above(double least) { return {least, kInfinity, false}; }
constexpr Range at_least(double least) { return {least}; }
constexpr Range from_to(double least, double most) { return {least, most}; }
constexpr Range from_to_below(double least, double most) { return {least, most, true, false}; }
constexpr Range above_to(double least, double most) { return {least, most, false, true}; }
constexpr Range between(double least, double most) { return {least, most, false, false}; }
constexpr Range or_none(Range range) {
  range.or_none = true;
  return range;
}
constexpr Range or_unset(double unset, Range range) {
  range.unset = unset;
  return range;
}

}  // namespace mpm
