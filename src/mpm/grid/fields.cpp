#include "mpm/grid/fields.hpp"

#include <fmt/core.h>

#include <limits>

namespace mpm {

void check_field_count(const GridLayout& layout, int count) {
  // The sort numbers a node by field, block and place in its block (step/sorter.hpp).
  const std::uint64_t most = std::numeric_limits<std::uint64_t>::max() / (64 * layout.keys());
  if (static_cast<std::uint64_t>(count) > most) {
    throw GridError(
        fmt::format("grid: the domain holds more cells than can be numbered in {} velocity fields; use a "
                    "coarser cell or a smaller domain",
                    count));
  }
}

Fields make_fields(const GridLayout& layout, int count) {
  check_field_count(layout, count);
  Fields fields;
  for (int f = 0; f < count; ++f) fields.push_back(std::make_unique<Grid>(layout));
  return fields;
}

}  // namespace mpm
