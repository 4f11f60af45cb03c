#include "study/row.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <istream>
#include <ostream>

namespace mpm::study {
namespace {

std::string cell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

/// Writing and reading of a column.
struct RowColumn {
  const char* name;
  std::string (*write)(const Row&);
  void (*read)(Row&, const std::string&);
};

double number(const std::string& text) {
  if (text.empty()) return kUnknown;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (*end != '\0') throw StudyError("'" + text + "' is not a number");
  return value;
}

template <std::string Row::*Member>
RowColumn text_column(const char* name) {
  return {name, [](const Row& row) { return row.*Member; },
          [](Row& row, const std::string& text) { row.*Member = text; }};
}
template <double Row::*Member>
RowColumn number_column(const char* name) {
  return {name, [](const Row& row) { return cell(row.*Member); },
          [](Row& row, const std::string& text) { row.*Member = number(text); }};
}
template <auto Member>
RowColumn count_column(const char* name) {
  return {name, [](const Row& row) { return fmt::format("{}", row.*Member); },
          [](Row& row, const std::string& text) {
            using Count = std::decay_t<decltype(row.*Member)>;
            row.*Member = static_cast<Count>(number(text));
          }};
}

const std::vector<RowColumn>& columns() {
  static const std::vector<RowColumn> list = {
      text_column<&Row::suite>("suite"),
      text_column<&Row::method>("method"),
      text_column<&Row::shape>("shape"),
      text_column<&Row::update>("update"),
      text_column<&Row::transfer>("transfer"),
      text_column<&Row::precision>("precision"),
      text_column<&Row::geometry>("geometry"),
      count_column<&Row::cells>("cells"),
      count_column<&Row::particles_per_cell>("ppc"),
      number_column<&Row::cfl>("cfl"),
      count_column<&Row::steps>("steps"),
      count_column<&Row::particles>("particles"),
      number_column<&Row::error>("error"),
      text_column<&Row::error_measure>("error_measure"),
      number_column<&Row::cpu_seconds>("cpu_seconds"),
      number_column<&Row::relative_cost>("relative_cost"),
      number_column<&Row::cost>("cost"),
      number_column<&Row::work>("work"),
      text_column<&Row::status>("status"),
      text_column<&Row::message>("message"),
  };
  return list;
}

/// Cells of one record; false at the end of the text. A quoted cell may hold line breaks.
bool read_record(std::istream& in, std::vector<std::string>& cells) {
  cells.assign(1, "");
  bool inside = false;
  char c = 0;
  if (in.peek() == std::istream::traits_type::eof()) return false;
  while (in.get(c)) {
    if (inside) {
      if (c != '"') {
        cells.back() += c;
      } else if (in.peek() == '"') {
        cells.back() += static_cast<char>(in.get());
      } else {
        inside = false;
      }
    } else if (c == '"') {
      inside = true;
    } else if (c == ',') {
      cells.emplace_back();
    } else if (c == '\n') {
      return true;
    } else {
      cells.back() += c;
    }
  }
  return true;
}

}  // namespace

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

void write_header(std::ostream& out) {
  for (const RowColumn& column : columns()) out << (&column == columns().data() ? "" : ",") << column.name;
  out << '\n';
}

void write_row(std::ostream& out, const Row& row) {
  for (const RowColumn& column : columns()) {
    out << (&column == columns().data() ? "" : ",") << quoted(column.write(row));
  }
  out << '\n' << std::flush;
}

std::vector<Row> read_rows(std::istream& in) {
  std::vector<std::string> cells;
  const bool some = read_record(in, cells);
  if (!some || cells.size() != columns().size()) throw StudyError("line 1: not the header of a table of runs");
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i] != columns()[i].name) {
      throw StudyError(fmt::format("line 1: column '{}' in place of '{}'", cells[i], columns()[i].name));
    }
  }
  std::vector<Row> rows;
  while (read_record(in, cells)) {
    const std::string place = fmt::format("run {}: ", rows.size() + 1);
    if (cells.size() != columns().size()) {
      throw StudyError(fmt::format("{}{} cells, not {}", place, cells.size(), columns().size()));
    }
    Row row;
    try {
      for (std::size_t i = 0; i < cells.size(); ++i) columns()[i].read(row, cells[i]);
    } catch (const StudyError& error) {
      throw StudyError(place + error.what());
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace mpm::study
