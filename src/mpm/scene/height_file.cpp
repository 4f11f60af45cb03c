// Heights of a height field from text or from an image.
#include "height_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <sstream>

namespace mpm {
namespace {

constexpr int kMostPoints = 1 << 15;  // points along an axis; a larger number in an image's header is not a size

HeightTable read_text(std::istream& stream, const std::string& path) {
  HeightTable table;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const auto refuse = [&](const std::string& what) {
      throw SceneError(fmt::format("{}:{}: {}", path, number, what));
    };
    if (!line.empty() && line[0] == '#') continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    int count = 0;
    for (std::string word; words >> word; ++count) {
      double value = 0.0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc() || end != word.data() + word.size()) refuse(fmt::format("'{}' is not a number", word));
      table.values.push_back(value);
    }
    if (count == 0) continue;
    if (table.rows > 0 && count != table.columns) {
      refuse(fmt::format("{} numbers, but {} in the rows before; write as many in each row", count, table.columns));
    }
    table.columns = count;
    ++table.rows;
  }
  return table;
}

/// The next number in the header of an image, after blanks and comments; -1 if there is none.
int head_number(std::istream& stream) {
  while (stream >> std::ws && stream.peek() == '#') stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  int number = 0;
  return stream >> number ? number : -1;
}

HeightTable read_image(std::istream& stream, const std::string& path) {
  std::string kind(2, ' ');
  stream.read(kind.data(), 2);
  HeightTable table;
  table.columns = head_number(stream);
  table.rows = head_number(stream);
  const int white = head_number(stream);
  const auto between = [](int value, int most) { return value > 0 && value <= most; };
  if ((kind != "P2" && kind != "P5") || !between(table.columns, kMostPoints) || !between(table.rows, kMostPoints) ||
      !between(white, 65535)) {
    throw SceneError(path + ": not a greyscale image; write it as PGM (P2 or P5)");
  }
  stream.get();  // the single blank after the header
  const auto next = [&]() -> int {
    if (kind == "P2") return head_number(stream);
    const int high = white > 255 ? stream.get() : 0;
    return 256 * high + stream.get();
  };
  table.values.resize(static_cast<std::size_t>(table.columns) * table.rows);
  for (int row = table.rows; row-- > 0;) {
    for (int column = 0; column < table.columns; ++column) {
      const int value = next();
      if (!stream || value < 0 || value > white)
        throw SceneError(fmt::format("{}: the image ends early, or has a pixel above its white of {}", path, white));
      table.values[static_cast<std::size_t>(row) * table.columns + column] = static_cast<double>(value) / white;
    }
  }
  return table;
}

}  // namespace

HeightTable read_height_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream || stream.peek() == std::ifstream::traits_type::eof())
    throw SceneError(path + ": cannot be read, or is empty; check the path and its permissions");
  const bool image = path.size() > 4 && path.compare(path.size() - 4, 4, ".pgm") == 0;
  return image ? read_image(stream, path) : read_text(stream, path);
}

}  // namespace mpm
