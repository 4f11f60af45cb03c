// Heights from text and from PGM images; which reader a file needs.
#include "height_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <fstream>
#include <limits>

namespace mpm {
namespace {

constexpr double kMostPoints = 1 << 26;  // in all: half a gigabyte of heights, 160 m by 160 m in steps of 2 cm

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
  table.of_white = true;
  table.columns = head_number(stream);
  table.rows = head_number(stream);
  const int white = head_number(stream);
  if ((kind != "P2" && kind != "P5") || table.columns < 0 || table.rows < 0 || white < 1 || white > 65535)
    throw SceneError(path + ": not a greyscale image; write it as PGM (P2 or P5)");
  check_height_points(path, table.columns, table.rows);
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

/// Whether a file is no text: it has bytes that are no characters.
bool is_binary(const std::string& bytes) {
  return std::any_of(bytes.begin(), bytes.end(), [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return code < 32 && std::strchr("\t\n\v\f\r", c) == nullptr;
  });
}

}  // namespace

void check_height_points(const std::string& path, double columns, double rows) {
  if (columns < 1 || rows < 1) throw SceneError(path + ": it has no points; write one height at least a row");
  if (columns * rows <= kMostPoints) return;
  throw SceneError(
      fmt::format("{}: {:.0f} x {:.0f} points are more than {:.0f}, for which memory is kept; cut out the part that is "
                  "needed, or make it coarser",
                  path, columns, rows, kMostPoints));
}

HeightTable read_height_text(std::istream& stream, const std::string& label) {
  HeightTable table;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const auto refuse = [&](const std::string& what) {
      throw SceneError(fmt::format("{}:{}: {}", label, number, what));
    };
    if (!line.empty() && line[0] == '#') continue;
    int count = 0;
    const auto blank = [](char c) { return c == ',' || std::strchr(" \t\r\v\f", c) != nullptr; };
    for (const char *at = line.data(), *end = at + line.size();; ++count) {
      at = std::find_if_not(at, end, blank);
      if (at == end) break;
      const char* stop = std::find_if(at, end, blank);
      double value = 0.0;
      const auto [rest, error] = std::from_chars(at, stop, value);
      if (error != std::errc() || rest != stop) refuse(fmt::format("'{}' is not a number", std::string(at, stop)));
      table.values.push_back(value);
      at = stop;
    }
    if (count == 0) continue;
    if (table.rows > 0 && count != table.columns) {
      refuse(fmt::format("{} numbers, but {} in the rows before; write as many in each row", count, table.columns));
    }
    table.columns = count;
    ++table.rows;
    check_height_points(label, table.columns, table.rows);
  }
  check_height_points(label, table.columns, table.rows);
  return table;
}

HeightTable read_height_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::array<char, 512> start{};
  stream.read(start.data(), start.size());
  const std::string bytes(start.data(), static_cast<std::size_t>(stream.gcount()));
  if (bytes.empty()) throw SceneError(path + ": cannot be read, or is empty; check the path and its permissions");
  stream.clear();
  stream.seekg(0);
  const auto begins = [&](const std::string& text) { return bytes.compare(0, text.size(), text) == 0; };
  using namespace std::string_literals;
  if (begins("\x89PNG")) return read_height_png(path);
  // TIFF and BigTIFF in either order of bytes.
  if (begins("II*\0"s) || begins("MM\0*"s) || begins("II+\0"s) || begins("MM\0+"s)) return read_height_tiff(path);
  if (bytes.size() > 1 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '7') return read_image(stream, path);
  if (is_binary(bytes))
    throw SceneError(path + ": neither text nor an image in PNG, PGM or TIFF; write the heights as one of these");
  return read_height_text(stream, path);
}

}  // namespace mpm
