// The shape of a rigid body that is a height_field: from a list, an expression of x and y, or a file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "height_file.hpp"
#include "mpm/scene/sections.hpp"

namespace mpm {
namespace {

constexpr int kMostCells = 4096;  // of an expression's points, along an axis

/// Reads an extent `[from, to]` [m].
void read_extent(const Value& value, int axis, HeightGrid& grid) {
  const std::vector<Value> ends = value.elements();
  if (ends.size() != 2) value.fail(fmt::format("found {} numbers; write [from, to]", ends.size()));
  grid.low[axis] = ends[0].number(kLength);
  grid.high[axis] = ends[1].number(kLength);
  if (!(grid.high[axis] > grid.low[axis])) value.fail("it ends where it begins or before; write [from, to]");
}

int read_cells(const Value& value) {
  const int cells = value.integer();
  if (cells < 1 || cells > kMostCells) value.fail(fmt::format("{} cells; write 1 to {}", cells, kMostCells));
  return cells;
}

/// Chooses the points along x and y at which an expression is evaluated: `cells` if given, else about the background
/// grid's size.
void choose_points(const Map& map, const SimulationDefinition& definition, bool in_plane, HeightGrid& grid) {
  const auto fine = [&](int axis) {
    const double cells = std::ceil((grid.high[axis] - grid.low[axis]) / definition.grid.cell[axis] - 1e-9);
    return static_cast<int>(std::clamp(cells, 1.0, static_cast<double>(kMostCells)));
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
}

void sample(const Value& value, HeightGrid& grid) {
  const Function height = value.function(kLength);
  try {
    for (int j = 0; j < grid.rows; ++j) {
      for (int i = 0; i < grid.columns; ++i) {
        const double u = static_cast<double>(i) / (grid.columns - 1);
        const double v = grid.rows > 1 ? static_cast<double>(j) / (grid.rows - 1) : 0.0;
        const Vec2 place = grid.low + (grid.high - grid.low).cwiseProduct(Vec2(u, v));
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

void read_file(const Value& value, const Map& map, bool in_plane, HeightGrid& grid) {
  std::string path = value.text();
  const auto scale_key = map.find("scale");
  if (!scale_key && path.size() > 4 && path.compare(path.size() - 4, 4, ".pgm") == 0)
    value.fail("an image has no heights of its own; write scale, the height of white above black");
  const double scale = scale_key ? scale_key->positive(kLength) : value.context().units.factor(kLength);
  if (path.find("://") == std::string::npos && std::filesystem::path(path).is_relative())
    path = (std::filesystem::path(value.context().source->label()).parent_path() / path).string();
  HeightTable table;
  try {
    table = read_height_file(resolve_resource(path));
  } catch (const Error& error) {
    value.fail(error.what());
  }
  if (in_plane && table.columns == 1) std::swap(table.columns, table.rows);
  if (in_plane && table.rows != 1) {
    value.fail(fmt::format("it has {} rows of {} heights; a planar scene takes one row or one column", table.rows,
                           table.columns));
  }
  grid.columns = table.columns;
  grid.rows = table.rows;
  for (const double height : table.values) grid.heights.push_back(scale * height);
}

}  // namespace

std::unique_ptr<Surface> read_height_field(const Value& value, const SimulationDefinition& definition) {
  if (axisymmetric(definition.geometry)) value.fail("a height field is not a body of revolution; write revolved");
  if (definition.geometry == GeometryKind::line) value.fail("a line has no height field; write plane, box or sphere");
  const bool in_plane = planar(definition.geometry);
  const Map map(value, {"x", "y", "heights", "cells", "file", "scale"});
  HeightGrid grid;
  read_extent(map.at("x"), 0, grid);
  if (in_plane) {
    if (const auto y = map.find("y")) y->fail("a planar scene's height field has no end along y; leave it out");
  } else {
    read_extent(map.at("y"), 1, grid);
  }
  const auto heights = map.find("heights");
  const auto file = map.find("file");
  if (heights.has_value() == file.has_value()) value.fail("a height field has heights or file; write one of them");
  const bool expression = heights && heights->is_text();
  if (const auto cells = map.find("cells"); cells && !expression)
    cells->fail("the list or file determines the number of points; leave it out");
  if (const auto scale = map.find("scale"); scale && !file) scale->fail("belongs to file; leave it out");
  if (expression) {
    choose_points(map, definition, in_plane, grid);
    sample(*heights, grid);
  } else if (heights) {
    read_list(*heights, in_plane, grid);
  } else {
    read_file(*file, map, in_plane, grid);
  }
  if (grid.columns < 2 || (!in_plane && grid.rows < 2))
    (heights ? *heights : *file).fail("it needs two points at least along each axis");
  try {
    return make_height_field(grid);
  } catch (const RigidError& error) {
    (heights ? *heights : *file).fail(error.what());
  }
}

}  // namespace mpm
