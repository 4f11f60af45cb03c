#include "mpm/definition/tool_size.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "mpm/math/constants.hpp"

namespace mpm {
namespace {

constexpr double kTooLong = 10.0;  ///< times the grid: a floor or a wall may be longer than the grid, and is thin
constexpr double kTooLarge = 3.0;  ///< times the grid along every axis: it may hold the tip of a sphere alone

}  // namespace

std::string size_doubt(const RigidBodyDefinition& body, const SimulationDefinition& definition) {
  const Vec3 size = body.surface->bounds().size(), domain = definition.grid.max - definition.grid.min;
  double longest = 0.0, shortest = kInfinity, grid = 0.0;
  for (const int axis : axes_of(definition.geometry)) {
    longest = std::max(longest, size[axis]);
    shortest = std::min(shortest, size[axis]);
    grid = std::max(grid, domain[axis]);
  }
  if (!std::isfinite(longest) || !(longest > kTooLong * grid || shortest > kTooLarge * grid)) return {};
  return fmt::format("rigid body '{}' is {:.4g} m long in a grid of {:.4g} m: check its unit (scale)", body.name,
                     longest, grid);
}

}  // namespace mpm
