// The shape that is a height_field: its heights from a list, an expression of x and y, text or a file.
#include "height_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "mpm/terrain/height_file.hpp"
#include "mpm/terrain/terrain.hpp"

namespace mpm {
namespace {

constexpr int kMostCells = 4096;     // most cells of an expression's points, along an axis
constexpr double kSpanSlack = 1e-6;  // part of a pixel

int read_cells(const Value& value) {
  const int cells = value.integer();
  if (cells < 1 || cells > kMostCells) value.fail(fmt::format("{} cells; write 1 to {}", cells, kMostCells));
  return cells;
}

/// Chooses the points along x and y at which an expression is evaluated: `cells` if given, else about the background
/// grid's size.
void choose_points(const Map& map, const SimulationDefinition& definition, bool in_plane, const HeightLimit& limit,
                   HeightGrid& grid) {
  const double most = in_plane ? kMostCells : std::min<double>(kMostCells, std::sqrt(limit.points) - 1.0);
  const auto fine = [&](int axis) {
    const double cells = std::ceil((grid.high[axis] - grid.low[axis]) / definition.grid.cell[axis] - 1e-9);
    return static_cast<int>(std::clamp(cells, 1.0, most));
  };
  grid.columns = fine(0) + 1;
  if (!in_plane) grid.rows = fine(1) + 1;
  const auto key = map.find("cells");
  if (!key) return;
  if (in_plane) {
    grid.columns = read_cells(*key) + 1;
    return;
  }
  const std::vector<Value> counts = key->elements();
  if (counts.size() != 2) key->fail("write the number of cells along x and along y, [nx, ny]");
  grid.columns = read_cells(counts[0]) + 1;
  grid.rows = read_cells(counts[1]) + 1;
  if (static_cast<double>(grid.columns) * grid.rows > limit.points) {
    key->fail(fmt::format("{} x {} points are more than {:.0f}, the most that {} may have; write fewer cells",
                          grid.columns, grid.rows, limit.points, limit.of));
  }
}

void sample(const Value& value, HeightGrid& grid) {
  const Function height = value.function(kLength);
  grid.heights.reserve(static_cast<std::size_t>(grid.columns) * grid.rows);
  try {
    for (int j = 0; j < grid.rows; ++j) {
      for (int i = 0; i < grid.columns; ++i) {
        const Vec2 place = place_of(grid, i, j);
        grid.heights.push_back(height(0.0, {place.x(), place.y(), 0.0}));
      }
    }
  } catch (const FunctionError& error) {
    value.fail(error.what());
  }
}

void read_list(const Value& value, bool in_plane, HeightGrid& grid) {
  const std::vector<Value> rows = in_plane ? std::vector<Value>{value} : value.elements();
  grid.rows = static_cast<int>(rows.size());
  for (const Value& row : rows) {
    const std::vector<Value> heights = row.elements();
    grid.columns = static_cast<int>(heights.size());
    if (heights.size() != rows.front().elements().size())
      row.fail(fmt::format("{} heights, but {} in the first row", heights.size(), rows.front().elements().size()));
    for (const Value& height : heights) grid.heights.push_back(height.number(kLength));
  }
}

/// Reads `file`, or text in `table`.
HeightTable read_table(const Value& value, bool from_file, const HeightLimit& limit) {
  try {
    if (!from_file) {
      std::istringstream text(value.text());
      return read_height_text(text, "its text", limit);
    }
    return read_height_file(resolve_resource(path_from_scene(value)), limit);
  } catch (const Error& error) {
    value.fail(error.what());
  }
}

void take_table(const Value& value, const Map& map, bool in_plane, HeightTable& table, HeightGrid& grid) {
  const auto scale_key = map.find("scale"), offset_key = map.find("offset");
  if (!scale_key && table.of_white)
    value.fail("an image has no heights of its own; write scale, the height of white above black");
  if (!scale_key && !table.unit_fault.empty())
    value.fail(table.unit_fault + "; write scale, the length that its number 1 stands for");
  // A scale that is written says what the numbers are, whatever the file says of them.
  const double scale =
      scale_key ? scale_key->positive(kLength) : table.unit.value_or(value.context().units.factor(kLength));
  const double offset = offset_key ? offset_key->number(kLength) : 0.0;
  if (in_plane && table.columns == 1) std::swap(table.columns, table.rows);
  if (in_plane && table.rows != 1) {
    value.fail(fmt::format("it has {} rows of {} heights; a planar scene takes one row or one column", table.rows,
                           table.columns));
  }
  grid.columns = table.columns;
  grid.rows = table.rows;
  grid.heights = std::move(table.values);
  for (double& height : grid.heights) height = scale * height + offset;
}

/// Reads where the heights lie: as written, which must fit what the file says of its size, else as the file says.
void read_place(const Map& map, const Value& source, int axis, const HeightTable& table, HeightGrid& grid) {
  const char* name = axis == 0 ? "x" : "y";
  const auto key = map.find(name);
  if (!key) {
    if (!table.span) {
      source.fail(
          fmt::format("{}; write x and y, from where to where it reaches, such as {}: [0, 20]", table.no_span, name));
    }
    grid.low[axis] = table.span->first[axis];
    grid.high[axis] = table.span->second[axis];
    return;
  }
  read_extent(*key, axis, grid.low, grid.high);
  if (!table.span || grid.heights.empty()) return;
  // The edges of an image lie half a pixel beyond its outer points: either size is meant.
  const double given = grid.high[axis] - grid.low[axis];
  const double size = table.span->second[axis] - table.span->first[axis];
  const double pixel = size / ((axis == 0 ? grid.columns : grid.rows) - 1);
  if (std::abs(given - size) <= pixel * (1.0 + kSpanSlack)) return;
  key->fail(fmt::format(
      "{:.6g} m, but the map measures {:.6g} m along {} ({} points {:.6g} m apart): write [{:.6g}, {:.6g}], "
      "or leave out x and y to place it by its own coordinates",
      given, size, name, axis == 0 ? grid.columns : grid.rows, pixel, grid.low[axis], grid.low[axis] + size));
}

}  // namespace

std::vector<std::string> height_keys(const std::vector<std::string>& more) {
  std::vector<std::string> keys = {"x", "y", "heights", "cells", "file", "table", "topic", "scale", "offset"};
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

Value height_source(const Map& map) {
  std::vector<Value> found;
  for (const char* key : {"heights", "file", "table", "topic"}) {
    if (const auto value = map.find(key)) found.push_back(*value);
  }
  if (found.size() != 1) map.fail("a height field has heights or file; write one of them");
  return found.front();
}

void read_extent(const Value& value, int axis, Vec2& low, Vec2& high) {
  const std::vector<Value> ends = value.elements();
  if (ends.size() != 2) value.fail(fmt::format("found {} numbers; write [from, to]", ends.size()));
  low[axis] = ends[0].number(kLength);
  high[axis] = ends[1].number(kLength);
  if (!(high[axis] > low[axis])) value.fail("it ends where it begins or before; write [from, to]");
}

HeightGrid read_height_grid(const Map& map, const SimulationDefinition& definition, bool over_grid,
                            const HeightLimit& limit) {
  const bool in_plane = planar(definition.geometry);
  if (const auto y = map.find("y"); y && in_plane)
    y->fail("a planar scene's height field has no end along y; leave it out");
  const Value source = height_source(map);
  if (map.find("topic")) {
    source.fail(
        "its heights come in a message, for which only the node waits; run the simulator's node, or write file");
  }
  const bool from_file = map.find("file").has_value(), is_table = from_file || map.find("table").has_value();
  const bool expression = !is_table && source.is_text();
  if (const auto cells = map.find("cells"); cells && !expression)
    cells->fail("the list or file determines the number of points; leave it out");
  for (const char* name : {"scale", "offset"}) {
    if (const auto key = map.find(name); key && !is_table) key->fail("belongs to file; leave it out");
  }
  HeightGrid grid;
  HeightTable table;
  if (is_table) {
    table = read_table(source, from_file, limit);
    take_table(source, map, in_plane, table, grid);
  } else if (!expression) {
    read_list(source, in_plane, grid);
  }
  if (!expression && (grid.columns < 2 || (!in_plane && grid.rows < 2)))
    source.fail("it needs two points at least along each axis");
  if (expression && over_grid) table.span = {definition.grid.min.head<2>(), definition.grid.max.head<2>()};
  for (int axis = 0; axis < (in_plane ? 1 : 2); ++axis) read_place(map, source, axis, table, grid);
  if (expression) {
    choose_points(map, definition, in_plane, limit, grid);
    sample(source, grid);
  }
  return grid;
}

void check_holes(const Value& source, const HeightGrid& map, const Vec2& low, const Vec2& high, const char* remedy) {
  const HeightPoints points = points_of(map, low, high);
  std::size_t count = 0;
  int column = 0, row = 0;
  for (int j = points.front; j <= points.back; ++j) {
    for (int i = points.left; i <= points.right; ++i) {
      if (std::isfinite(map.heights[static_cast<std::size_t>(j) * map.columns + i])) continue;
      if (count++ == 0) column = i, row = j;
    }
  }
  if (count == 0) return;
  const Vec2 place = place_of(map, column, row);
  source.fail(fmt::format(
      "{} of its points under the body have no height, the first at x = {:.6g} m, y = {:.6g} m (column {}, row "
      "{} from low y); {}",
      count, place.x(), place.y(), column + 1, row + 1, remedy));
}

std::unique_ptr<Surface> read_height_field(const Value& value, const SimulationDefinition& definition) {
  if (axisymmetric(definition.geometry)) value.fail("a height field is not a body of revolution; write revolved");
  if (definition.geometry == GeometryKind::line) value.fail("a line has no height field; write plane, box or sphere");
  const Map map(value, height_keys(),
                {{"bottom", "a rigid height field has no end downwards"}, {"within", "it is of deformable bodies"}});
  const HeightGrid grid = read_height_grid(map, definition, false, kToolLimit);
  check_holes(height_source(map), grid, grid.low, grid.high, "fill them");
  try {
    return make_height_field(grid);
  } catch (const RigidError& error) {
    height_source(map).fail(error.what());
  }
}

}  // namespace mpm
