#include "mpm/keys/range.hpp"

#include <fmt/format.h>

#include <cmath>

namespace mpm {

std::string Range::fault(double value, const Dimension& dimension) const {
  if (std::isnan(value)) return "is not a number";
  if (or_none && value == kInfinity) return {};
  if (std::isinf(value)) return "is not finite";
  if (value < least || (value == least && !with_least)) {
    return fmt::format("is {} {}", with_least ? "less than" : "not greater than", quantity_text(least, dimension));
  }
  if (value > most || (value == most && !with_most)) {
    return fmt::format("is {} {}", with_most ? "more than" : "not below", quantity_text(most, dimension));
  }
  return {};
}

std::string Range::words(const Dimension& dimension) const {
  const std::string low = quantity_text(least, dimension), high = quantity_text(most, dimension);
  if (std::isinf(least)) return {};
  if (std::isinf(most)) return with_least ? fmt::format("of {} or more", low) : fmt::format("above {}", low);
  if (with_least) return fmt::format("from {} to {}{}", low, with_most ? "" : "below ", high);
  if (with_most) return fmt::format("above {} and up to {}", low, high);
  return fmt::format("between {} and {}, both excluded", low, high);
}

std::string Range::signs(const Dimension& dimension) const {
  if (std::isinf(least) || std::isfinite(most)) return words(dimension);
  return fmt::format("{} {}", with_least ? "≥" : ">", quantity_text(least, dimension));
}

}  // namespace mpm
