// Tables of heights from files.
#pragma once

#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"

namespace mpm {

/// Numbers as a file has them, row by row.
struct HeightTable {
  int columns = 0, rows = 0;
  std::vector<double> values;  ///< of an image the first row is its lowest one, and white is 1
};

/// A greyscale image (PGM, plain or binary, 8 or 16 bits) where the name ends with .pgm; else text: a row a line,
/// numbers apart by commas or blanks, lines that begin with # left out.
/// @throws SceneError with the file and, of text, the line.
HeightTable read_height_file(const std::string& path);

}  // namespace mpm
