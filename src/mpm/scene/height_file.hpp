// Tables of heights from files: text, images (PGM, PNG) and GeoTIFF.
#pragma once

#include <istream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mpm/math/geometry.hpp"
#include "mpm/scene/scene.hpp"

namespace mpm {

/// Numbers of a file, row by row from low y, each from low x. NaN is a hole: the file says that it has no height there.
struct HeightTable {
  int columns = 0, rows = 0;
  std::vector<double> values;
  bool of_white = false;  ///< parts of white, 0 to 1, and not heights
  /// Of a GeoTIFF, in its own coordinates [m]: places of the first and of the last point.
  std::optional<std::pair<Vec2, Vec2>> span;
  std::string no_span = "it does not say how large it is";  ///< why there is no span, in an error
};

/// Reads what the file's first bytes say that it is: PNG or PGM (grey, of white), TIFF, else text with one row per
/// line, numbers separated by commas or blanks, and lines that begin with # skipped. @throws SceneError with the file
/// and, for text, the line; a file of another kind, or of too many points, is refused.
HeightTable read_height_file(const std::string& path);
/// Reads text as above; `label` stands for the file in errors.
HeightTable read_height_text(std::istream& stream, const std::string& label);
/// Reads grey PNG images. Samples of fewer than 16 bits are scaled by their own white. @throws SceneError
HeightTable read_height_png(const std::string& path);
/// Reads TIFF with one sample a pixel, an integer or a floating-point number of 8 to 64 bits, in strips or tiles. Size
/// and place come from ModelPixelScale and ModelTiepoint (OGC 19-008r4, GeoTIFF 1.1, sections 7.3 and 7.4 and annex
/// B.6) and holes from GDAL_NODATA. A map whose coordinates are degrees has no span. @throws SceneError
HeightTable read_height_tiff(const std::string& path);
/// Refuses a table without points, or so large that it is not meant. @throws SceneError
void check_height_points(const std::string& path, double columns, double rows);

}  // namespace mpm
