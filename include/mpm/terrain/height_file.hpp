// Tables of heights from files: text, images (PGM, PNG) and GeoTIFF; and to GeoTIFF.
#pragma once

#include <istream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mpm/math/geometry.hpp"
#include "mpm/rigid/surface.hpp"
#include "mpm/scene/scene.hpp"

namespace mpm {

/// Numbers of a file, row by row from low y, each from low x. NaN is a hole: the file says that it has no height there.
struct HeightTable {
  int columns = 0, rows = 0;
  std::vector<double> values;
  bool of_white = false;       ///< parts of white, 0 to 1, and not heights
  std::optional<double> unit;  ///< length that the number 1 of a GeoTIFF stands for, if it says so [m]
  std::string unit_fault;      ///< fault of the unit that it says; empty if that is known, or if it says none
  /// Places of the first and of the last point of a GeoTIFF, in its own coordinates [m].
  std::optional<std::pair<Vec2, Vec2>> span;
  std::string no_span = "it does not say how large it is";  ///< reason why there is no span, in an error
};

/// Number of points that a map may have, and of what: the rest of "the most that ... may have".
struct HeightLimit {
  double points;
  const char* of;
};
/// Half a gigabyte of heights, 160 m by 160 m in steps of 2 cm.
inline constexpr HeightLimit kGroundLimit{1 << 26, "a map"};
/// Maps that are drawn, searched and sent to RViz as triangles, two a point.
inline constexpr HeightLimit kToolLimit{1 << 20, "a map of a rigid body"};
/// Maps that are read in a second or two.
inline constexpr HeightLimit kTextLimit{1 << 24, "a map in text (write it as GeoTIFF)"};

/// Reads what the file's first bytes say that it is: PNG or PGM (grey, of white), TIFF, else text.
/// @throws SceneError with the file and, for text, the line; a file of another kind, or of too many points, is refused.
HeightTable read_height_file(const std::string& path, const HeightLimit& limit);
/// Reads rows of as many numbers each, one a line, after a byte order mark if there is one: divided by commas, one
/// between two numbers, or by blanks. Lines that begin with # are skipped. `label` stands for the file in errors.
/// @throws SceneError with the line, also where commas and blanks both divide, as decimal commas between blanks do
HeightTable read_number_text(std::istream& stream, const std::string& label, const HeightLimit& limit);
/// Reads heights so. @throws SceneError as above, and for a list of points, x y z, on a lattice
HeightTable read_height_text(std::istream& stream, const std::string& label, const HeightLimit& limit);
/// Reads grey PNG images. Samples of fewer than 16 bits are scaled by their own white. @throws SceneError
HeightTable read_height_png(const std::string& path, const HeightLimit& limit);
/// Reads TIFF with one sample a pixel, an integer or a floating-point number of 8 to 64 bits, in strips or tiles. Size
/// and place come from ModelPixelScale and ModelTiepoint (OGC 19-008r4, GeoTIFF 1.1, sections 7.3 and 7.4 and annex
/// B.6), the unit of heights from VerticalUnits and VerticalGeoKey, and holes from GDAL_NODATA. A map whose coordinates
/// are degrees has no span. @throws SceneError
HeightTable read_height_tiff(const std::string& path, const HeightLimit& limit);
/// Writes heights as GeoTIFF, which the above reads back to the bit: 64 bits a height, in metres, NaN for a hole,
/// placed by the points themselves (PixelIsPoint). A planar map has one line. Replaces a file when the new one is
/// whole.
/// @throws SceneError where it cannot be written
void write_height_tiff(const std::string& path, const HeightGrid& map);
/// Refuses a table without points, or of more than the limit. @throws SceneError
void check_height_points(const std::string& path, double columns, double rows, const HeightLimit& limit);

}  // namespace mpm
