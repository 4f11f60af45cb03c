// Heights from PGM images; which reader a file needs.
#include "mpm/terrain/height_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <limits>

#include "mpm/math/input_file.hpp"

namespace mpm {
namespace {

/// The next number in the header of an image, after blanks and comments; -1 if there is none.
int head_number(std::istream& stream) {
  while (stream >> std::ws && stream.peek() == '#') stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  int number = 0;
  return stream >> number ? number : -1;
}

HeightTable read_image(std::istream& stream, const std::string& path, const HeightLimit& limit) {
  std::string kind(2, ' ');
  stream.read(kind.data(), 2);
  HeightTable table;
  table.of_white = true;
  table.columns = head_number(stream);
  table.rows = head_number(stream);
  const int white = head_number(stream);
  if ((kind != "P2" && kind != "P5") || table.columns < 0 || table.rows < 0 || white < 1 || white > 65535)
    throw SceneError(path + ": not a greyscale image; write it as PGM (P2 or P5)");
  check_height_points(path, table.columns, table.rows, limit);
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

/// True if a file is no text: it has bytes that are no characters.
bool is_binary(const std::string& bytes) {
  return std::any_of(bytes.begin(), bytes.end(), [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return code < 32 && std::strchr("\t\n\v\f\r", c) == nullptr;
  });
}

}  // namespace

void check_height_points(const std::string& path, double columns, double rows, const HeightLimit& limit) {
  if (columns < 1 || rows < 1) throw SceneError(path + ": it has no points; write one height at least a row");
  if (columns * rows <= limit.points) return;
  throw SceneError(fmt::format(
      "{}: {:.0f} x {:.0f} points are more than {:.0f}, the most that {} may have; cut out the part that is "
      "needed, or make it coarser",
      path, columns, rows, limit.points, limit.of));
}

HeightTable read_height_file(const std::string& path, const HeightLimit& limit) {
  std::ifstream stream;
  if (const std::string refused = open_input(stream, path); !refused.empty())
    throw SceneError(fmt::format("{}: {}", path, refused));
  std::array<char, 512> start{};
  stream.read(start.data(), start.size());
  const std::string bytes(start.data(), static_cast<std::size_t>(stream.gcount()));
  if (bytes.empty()) throw SceneError(path + ": it is empty; write heights");
  stream.clear();
  stream.seekg(0);
  const auto begins = [&](const std::string& text) { return bytes.compare(0, text.size(), text) == 0; };
  using namespace std::string_literals;
  if (begins("\x89PNG")) return read_height_png(path, limit);
  // TIFF and BigTIFF in either order of bytes.
  if (begins("II*\0"s) || begins("MM\0*"s) || begins("II+\0"s) || begins("MM\0+"s))
    return read_height_tiff(path, limit);
  if (bytes.size() > 1 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '7') return read_image(stream, path, limit);
  if (is_binary(bytes))
    throw SceneError(path + ": neither text nor an image in PNG, PGM or TIFF; write the heights as one of these");
  return read_height_text(stream, path, limit);
}

}  // namespace mpm
