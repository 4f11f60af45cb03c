// Paths of strain and stress from CSV files.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "mpm/math/input_file.hpp"
#include "mpm/math/nearest.hpp"
#include "mpm/sections/material_driver.hpp"
#include "mpm/yaml/units.hpp"

namespace mpm {
namespace {

struct Column {
  std::string name;
  int component = 0;
  Control control = Control::strain;
  double unit = 1.0;  ///< factor to SI
};

std::string trimmed(const std::string& text) {
  const char* const blanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(blanks);
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result(1);
  for (const char c : line) {
    if (c == ',') {
      result.emplace_back();
    } else {
      result.back() += c;
    }
  }
  for (std::string& cell : result) cell = trimmed(cell);
  return result;
}

/// "e", "g" or "s" and a component: exx … exy, gyz, gxz, gxy, sxx … sxy.
const std::vector<std::string>& column_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const char letter : {'e', 'g', 's'}) {
      for (int k = letter == 'g' ? 3 : 0; k < kComponents; ++k)
        list.push_back(letter + std::string(kComponentNames[k]));
    }
    return list;
  }();
  return names;
}

class PathFile {
 public:
  PathFile(const std::string& file, int steps) : file_(file), steps_(steps) {}

  StrainPath read() {
    std::ifstream stream;
    if (const std::string refused = open_input(stream, file_); !refused.empty())
      throw PathError(fmt::format("{}: {}", file_, refused));
    for (std::string text; std::getline(stream, text);) {
      ++line_;
      text = trimmed(text);
      if (text.empty() || text[0] == '#') continue;
      if (columns_.empty()) {
        read_header(cells(text));
      } else {
        read_row(cells(text));
      }
    }
    if (columns_.empty()) fail("no header; write one, such as t, ezz, sxx, syy");
    if (path_.empty()) fail("no row after t = 0; write one for the end of each leg");
    return path_;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw PathError(fmt::format("{}:{}: {}", file_, line_, what));
  }

  /// The factor of a unit in brackets behind the name, which is cut off.
  double take_unit(std::string& name, const Dimension& dimension) const {
    const std::size_t bracket = name.find('[');
    if (bracket == std::string::npos) return 1.0;
    if (name.back() != ']') fail(fmt::format("'{}': a unit stands in brackets, as in sxx [kPa]", name));
    const std::string text = trimmed(name.substr(bracket + 1, name.size() - bracket - 2));
    name = trimmed(name.substr(0, bracket));
    if (text == "1") return 1.0;
    try {
      const Unit unit = parse_unit(text);
      if (!(unit.dimension == dimension)) {
        fail(fmt::format("'{}' is in {}; write {}", name, text, describe(dimension)));
      }
      return unit.factor;
    } catch (const UnitError& error) {
      fail(fmt::format("'{}': {}", name, error.what()));
    }
  }

  void read_header(std::vector<std::string> names) {
    std::string time = names[0];
    time_unit_ = take_unit(time, kTime);
    if (time != "t" && time != "time") fail(fmt::format("the first column is '{}'; it must be the time, t", time));
    if (names.size() < 2) fail("no column beside t; write strains or stresses, such as ezz, sxx");
    std::array<bool, kComponents> taken{};
    for (std::size_t i = 1; i < names.size(); ++i) {
      Column column;
      column.unit = take_unit(names[i], names[i][0] == 's' ? kPressure : kPlain);
      const std::string& name = column.name = names[i];
      if (std::find(column_names().begin(), column_names().end(), name) == column_names().end()) {
        fail(fmt::format("unknown column '{}'; {}", name, suggest(name, column_names())));
      }
      while (name.substr(1) != kComponentNames[column.component]) ++column.component;
      if (name[0] == 'g') column.control = Control::simple_shear;
      if (name[0] == 's') column.control = Control::stress;
      if (taken[column.component]) {
        fail(fmt::format("'{}': the component {} has a column already; strain it or stress it", name,
                         kComponentNames[column.component]));
      }
      taken[column.component] = true;
      columns_.push_back(column);
    }
  }

  double number(const std::string& cell, const std::string& what) const {
    double value = 0.0;
    std::string rest;
    if (!split_number(cell, value, rest) || !rest.empty() || !std::isfinite(value)) {
      fail(fmt::format("{}: '{}' is not a finite number; units stand in the header", what, cell));
    }
    return value;
  }

  void read_row(const std::vector<std::string>& row) {
    if (row.size() != columns_.size() + 1) {
      fail(fmt::format("{} cells under {} columns", row.size(), columns_.size() + 1));
    }
    const double time = time_unit_ * number(row[0], "t");
    Leg leg;
    leg.steps = steps_;
    leg.duration = time - time_;
    bool at_rest = true;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Column& column = columns_[i];
      const double value = column.unit * number(row[i + 1], column.name);
      leg.control[column.component] = column.control;
      leg.target[column.component] = value;
      at_rest = at_rest && value == 0.0;
    }
    if (time == 0.0 && path_.empty()) {
      if (!at_rest) fail("at t = 0 the material is at rest and undeformed; write 0, or begin with the end of a leg");
      return;
    }
    if (!(time > time_)) fail(fmt::format("t = {:g} s is not after {:g} s; rows go forward in time", time, time_));
    time_ = time;
    path_.push_back(leg);
  }

  std::string file_;
  int steps_;
  int line_ = 0;
  double time_unit_ = 1.0;
  double time_ = 0.0;  ///< time of the last row [s]
  std::vector<Column> columns_;
  StrainPath path_;
};

}  // namespace

StrainPath read_path_file(const std::string& file, int steps) { return PathFile(file, steps).read(); }

}  // namespace mpm
