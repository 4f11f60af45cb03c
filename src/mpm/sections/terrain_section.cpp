// The shape of a deformable body that is a height_field: ground from a level up to the heights.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "height_section.hpp"
#include "mpm/math/constants.hpp"
#include "mpm/terrain/terrain.hpp"

namespace mpm {
namespace {

constexpr double kTerrainSlack = 1e-6;  // part of a cell by which ends may differ

/// A unit in which heights may have been written although the scene takes them for another.
struct OtherUnit {
  const char* name;
  double factor;
};
constexpr std::array<OtherUnit, 3> kOtherUnits = {{{"feet", 0.3048}, {"centimetres", 0.01}, {"millimetres", 0.001}}};

/// Reads `within`, the part of the map that the body is.
void read_within(const Map& map, const HeightGrid& grid, bool in_plane, Vec2& low, Vec2& high) {
  low = grid.low;
  high = grid.high;
  const auto within = map.find("within");
  if (!within) return;
  const Map part(*within, {"x", "y"});
  if (const auto y = part.find("y"); y && in_plane) y->fail("a planar scene has no end along y; leave it out");
  for (int axis = 0; axis < (in_plane ? 1 : 2); ++axis) {
    const auto key = part.find(axis == 0 ? "x" : "y");
    if (!key) continue;
    read_extent(*key, axis, low, high);
    const double slack =
        kTerrainSlack * (grid.high[axis] - grid.low[axis]) / std::max(1, (axis == 0 ? grid.columns : grid.rows) - 1);
    if (low[axis] < grid.low[axis] - slack || high[axis] > grid.high[axis] + slack) {
      key->fail(fmt::format("it leaves the map, which reaches from {:.6g} to {:.6g} m; write a part of that",
                            grid.low[axis], grid.high[axis]));
    }
  }
}

/// Refuses a body that leaves the grid, above all one that lies where its file's own coordinates are.
void check_terrain_extent(const Value& source, const Map& map, const GridDefinition& grid, const Vec2& low,
                          const Vec2& high, bool in_plane) {
  for (int axis = 0; axis < (in_plane ? 1 : 2); ++axis) {
    const double slack = kTerrainSlack * grid.cell[axis];
    if (low[axis] >= grid.min[axis] - slack && high[axis] <= grid.max[axis] + slack) continue;
    const char* name = axis_name(axis);
    const double size = high[axis] - low[axis], room = grid.max[axis] - grid.min[axis];
    const std::string remedy =
        size > room + slack
            ? fmt::format("enlarge the grid, or choose a part of it by within: {{{}: [from, to]}}", name)
            : fmt::format("write {}: [{:.6g}, {:.6g}], or move the grid", name, grid.min[axis], grid.min[axis] + size);
    const auto key = map.find(name);
    (key ? *key : source)
        .fail(fmt::format("the body reaches from {:.6g} to {:.6g} m along {}, out of the grid, {:.6g} to {:.6g} m; {}",
                          low[axis], high[axis], name, grid.min[axis], grid.max[axis], remedy));
  }
}

/// Refuses heights outside the grid; another unit is named in which they would fit.
void check_heights(const Value& source, const Map& map, const HeightGrid& grid, const HeightPoints& points,
                   const GridDefinition& room) {
  double lowest = kInfinity, highest = -kInfinity;
  Vec2 low_place = Vec2::Zero(), high_place = Vec2::Zero();
  for (int j = points.front; j <= points.back; ++j) {
    for (int i = points.left; i <= points.right; ++i) {
      const double height = grid.heights[static_cast<std::size_t>(j) * grid.columns + i];
      if (height < lowest) lowest = height, low_place = place_of(grid, i, j);
      if (height > highest) highest = height, high_place = place_of(grid, i, j);
    }
  }
  const double slack = kTerrainSlack * room.cell.z(), floor = room.min.z() - slack, ceiling = room.max.z() + slack;
  if (lowest >= floor && highest <= ceiling) return;
  const bool above = highest > ceiling;
  const Vec2& place = above ? high_place : low_place;
  const std::string fault =
      fmt::format("its {} point, {:.6g} m at x = {:.6g} m, y = {:.6g} m, is {}, {:.6g} m", above ? "highest" : "lowest",
                  above ? highest : lowest, place.x(), place.y(), above ? "above grid.max" : "below grid.min",
                  above ? room.max.z() : room.min.z());
  const auto scale = map.find("scale"), offset = map.find("offset");
  const bool is_table = !map.find("heights");
  for (const OtherUnit& unit : kOtherUnits) {
    if (offset || lowest * unit.factor < floor || highest * unit.factor > ceiling) continue;
    const double given = scale ? scale->number(kLength) : source.context().units.factor(kLength);
    source.fail(fmt::format("{}; in {} it would lie in the grid: write {}, else raise grid.max or {}", fault, unit.name,
                            is_table ? fmt::format("scale: {:g} m", given * unit.factor) : "each height with its unit",
                            is_table ? "write offset" : "other heights"));
  }
  source.fail(fmt::format("{}; {}, or move the grid", fault,
                          is_table ? "write scale and offset that put it in the grid" : "write other heights"));
}

}  // namespace

Region read_terrain(const Value& value, const SimulationDefinition& definition) {
  if (axisymmetric(definition.geometry))
    value.fail("a height field is not a body of revolution; write box or cylinder");
  if (definition.geometry == GeometryKind::line) value.fail("a line has no height field; write box");
  const bool in_plane = planar(definition.geometry);
  const Map map(value, height_keys({"bottom", "within"}));
  HeightGrid grid = read_height_grid(map, definition, true, kGroundLimit);
  const Value source = height_source(map);
  Vec2 low, high;
  read_within(map, grid, in_plane, low, high);
  check_terrain_extent(source, map, definition.grid, low, high, in_plane);
  check_holes(source, grid, low, high, "fill them, or leave them out by within: {x: [from, to], y: [from, to]}");
  check_heights(source, map, grid, points_of(grid, low, high), definition.grid);
  const auto key = map.find("bottom");
  const double bottom = key ? key->number(kLength) : definition.grid.min.z();
  const double slack = kTerrainSlack * definition.grid.cell.z();
  if (bottom < definition.grid.min.z() - slack)
    key->fail(fmt::format("it is below the grid, whose lower face is at {:g} m; write that or more",
                          definition.grid.min.z()));
  Region region;
  region.kind = Region::Kind::terrain;
  region.terrain = std::make_shared<const Terrain>(std::move(grid), low, high, bottom);
  const Box box = region.terrain->bounds();
  if (!(box.max.z() > bottom))
    (key ? *key : source)
        .fail("no height is above the level at which the body ends; write a lower bottom, or heights above it");
  return region;
}

}  // namespace mpm
