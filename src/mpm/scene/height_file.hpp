// Tables of heights from files.
#pragma once

#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"

namespace mpm {

/// Numbers of a file, row by row.
struct HeightTable {
  int columns = 0, rows = 0;
  std::vector<double> values;  ///< for an image the first row is its lowest one, and white is 1
};

/// Reads a greyscale image (PGM, plain or binary, 8 or 16 bits) if the name ends with .pgm; else text with one row per
/// line, numbers separated by commas or blanks, and lines that begin with # skipped. @throws SceneError with the file
/// and, for text, the line.
HeightTable read_height_file(const std::string& path);

}  // namespace mpm
