// The heights of a `height_field`, of rigid and of deformable bodies: where they come from and where they lie.
#pragma once

#include <string>
#include <vector>

#include "mpm/rigid/surface.hpp"
#include "mpm/sections/sections.hpp"
#include "mpm/terrain/height_file.hpp"

namespace mpm {

/// Keys of every height_field, and `more`.
std::vector<std::string> height_keys(const std::vector<std::string>& more = {});
/// The value that gives the heights, for errors about them: `heights`, `file`, `table` or `topic`.
Value height_source(const Map& map);
/// Reads the heights, with NaN in holes. Two points at least along each axis of the scene. `over_grid`: an expression
/// without x or y reaches over the background grid. `limit`: of points.
HeightGrid read_height_grid(const Map& map, const SimulationDefinition& definition, bool over_grid,
                            const HeightLimit& limit);
/// `[from, to]` of x (axis 0) or y [m].
void read_extent(const Value& value, int axis, Vec2& low, Vec2& high);
/// Refuses holes in the part of the map from `low` to `high` [m]; `remedy` says what to do about them.
void check_holes(const Value& source, const HeightGrid& map, const Vec2& low, const Vec2& high, const char* remedy);

}  // namespace mpm
