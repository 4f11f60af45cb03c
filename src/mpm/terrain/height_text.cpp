// Numbers from text, a row a line: heights, and points of cracks.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include "mpm/terrain/height_file.hpp"

namespace mpm {
namespace {

constexpr int kFewestPlaces = 6;     ///< places of a list of x y z; fewer may be heights by chance
constexpr double kEvenStep = 1e-3;   ///< part of a step: rounding of places that are written with few digits
constexpr double kFilledPart = 0.5;  ///< part of a lattice from which on a list of places is taken for one

bool is_blank(char c) { return std::strchr(" \t\r\v\f", c) != nullptr && c != '\0'; }

/// One line of a table. Its numbers stand between commas, each of which divides two of them, or between blanks alone.
class TextRow {
 public:
  TextRow(const std::string& line, std::string place) : line_(line), place_(std::move(place)) {}

  /// Appends the row's numbers. Returns how many there are.
  int read(std::vector<double>& values) {
    const char* at = line_.data();
    const char* const end = at + line_.size();
    const bool commas = line_.find(',') != std::string::npos;
    int count = 0;
    while (true) {
      at = std::find_if_not(at, end, is_blank);
      if (at == end && !commas) return count;
      const char* stop = commas ? std::find(at, end, ',') : std::find_if(at, end, is_blank);
      const char* const next = stop;
      while (stop != at && is_blank(stop[-1])) --stop;
      values.push_back(number(at, stop, ++count));
      if (next == end) return count;
      at = next + 1;
    }
  }

 private:
  double number(const char* at, const char* stop, int count) const {
    if (at == stop) {
      refuse(fmt::format("nothing stands in the place of number {}, at a comma; write a number, or nan for a hole",
                         count));
    }
    if (std::find_if(at, stop, is_blank) != stop) {
      std::string text(at, stop);
      std::replace_if(text.begin(), text.end(), is_blank, ' ');
      refuse(
          fmt::format("commas and blanks both divide its numbers, so that '{}' stands between commas: if these are "
                      "decimal commas, write points; else divide all by commas, or all by blanks",
                      text));
    }
    double value = 0.0;
    const auto [rest, error] = std::from_chars(at, stop, value);
    if (error == std::errc() && rest == stop) return value;
    const bool semicolon = std::find(at, stop, ';') != stop;
    refuse(fmt::format("'{}' is not a number{}", std::string(at, stop),
                       semicolon ? "; write commas or blanks between numbers, and decimal points" : ""));
  }
  [[noreturn]] void refuse(const std::string& what) const { throw SceneError(place_ + ": " + what); }

  const std::string& line_;
  std::string place_;
};

/// The places of points along one axis, in order, if they lie at equal distances; else none.
std::vector<double> even_places(const HeightTable& table, int axis) {
  std::vector<double> places;
  for (int row = 0; row < table.rows; ++row) places.push_back(table.values[static_cast<std::size_t>(3 * row + axis)]);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  if (places.size() < 2 || !std::isfinite(places.front() + places.back())) return {};
  const double step = (places.back() - places.front()) / static_cast<double>(places.size() - 1);
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (std::abs(places[i] - places[i - 1] - step) > kEvenStep * step) return {};
  }
  return places;
}

/// True if three columns are the x, y and height of points that lie on a lattice, each of them once.
bool lists_places(const HeightTable& table) {
  if (table.columns != 3 || table.rows < kFewestPlaces) return false;
  const double along_x = static_cast<double>(even_places(table, 0).size());
  const double along_y = static_cast<double>(even_places(table, 1).size());
  const double all = along_x * along_y;
  if (!(all >= table.rows) || table.rows < kFilledPart * all) return false;
  std::vector<std::pair<double, double>> pairs;
  for (std::size_t i = 0; i < table.values.size(); i += 3) pairs.emplace_back(table.values[i], table.values[i + 1]);
  std::sort(pairs.begin(), pairs.end());
  return std::adjacent_find(pairs.begin(), pairs.end()) == pairs.end();
}

}  // namespace

HeightTable read_number_text(std::istream& stream, const std::string& label, const HeightLimit& limit) {
  const HeightLimit& own = limit.points < kTextLimit.points ? limit : kTextLimit;
  const std::string mark = "\xEF\xBB\xBF";
  HeightTable table;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    if (++number == 1 && line.compare(0, mark.size(), mark) == 0) line.erase(0, mark.size());
    if (!line.empty() && line[0] == '#') continue;
    const int count = TextRow(line, fmt::format("{}:{}", label, number)).read(table.values);
    if (count == 0) continue;
    if (table.rows > 0 && count != table.columns) {
      throw SceneError(fmt::format("{}:{}: {} numbers, but {} in the rows before; write as many in each row", label,
                                   number, count, table.columns));
    }
    table.columns = count;
    ++table.rows;
    check_height_points(label, table.columns, table.rows, own);
  }
  check_height_points(label, table.columns, table.rows, own);
  return table;
}

HeightTable read_height_text(std::istream& stream, const std::string& label, const HeightLimit& limit) {
  HeightTable table = read_number_text(stream, label, limit);
  if (lists_places(table)) {
    throw SceneError(
        fmt::format("{}: its {} rows of three numbers are a list of points, x, y and height; write the heights alone, "
                    "in rows along y from low to high, each along x, and say by x and y where they lie",
                    label, table.rows));
  }
  return table;
}

}  // namespace mpm
