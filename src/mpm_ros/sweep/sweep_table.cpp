#include "mpm_ros/sweep/sweep_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "mpm/sweep/plan.hpp"
#include "mpm/yaml/units.hpp"

namespace mpm_ros {
namespace {

/// Values of a parameter as cells under a heading that has their unit, if they are numbers of one unit.
struct Column {
  std::string heading;
  std::vector<std::string> cells;
};

Column column_of(const std::string& path, const std::vector<std::string>& values) {
  Column column{path, {}};
  std::optional<std::string> unit;
  for (const std::string& value : values) {
    double number = 0.0;
    std::string rest;
    if (!mpm::split_number(value, number, rest) || (unit && *unit != rest)) return {path, values};
    unit = rest;
    column.cells.push_back(fmt::format("{}", number));
  }
  if (!unit || unit->empty()) return column;
  try {
    mpm::parse_unit(*unit);
  } catch (const mpm::UnitError&) {
    return {path, values};
  }
  column.heading = fmt::format("{} [{}]", path, *unit);
  return column;
}

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

std::string line_of(const std::vector<std::string>& cells) {
  std::vector<std::string> parts;
  for (const std::string& cell : cells) parts.push_back(quoted(cell));
  return fmt::format("{}\n", fmt::join(parts, ","));
}

}  // namespace

std::string SweepTable::counts() const {
  std::string text = fmt::format("{} done", done);
  if (failed > 0) text += fmt::format(", {} failed", failed);
  if (stopped > 0) text += fmt::format(", {} stopped", stopped);
  if (open > 0) text += fmt::format(", {} open", open);
  return text;
}

SweepTable read_sweep(const Study& study) {
  const mpm::sweep::Plan plan = mpm::sweep::read_plan(study.plan());
  const int runs = plan.runs();
  std::vector<std::vector<std::string>> values(plan.parameters.size());
  std::vector<RunResult> results;
  std::vector<std::string> metrics;  // metrics of all runs, each once
  for (int run = 1; run <= runs; ++run) {
    const std::vector<mpm::sweep::Setting> settings = plan.settings(run);
    for (std::size_t i = 0; i < settings.size(); ++i) values[i].push_back(settings[i].value);
    results.push_back(study.result(run));
    for (const auto& [name, value] : results.back().metrics) {
      if (std::find(metrics.begin(), metrics.end(), name) == metrics.end()) metrics.push_back(name);
    }
  }

  SweepTable table;
  table.parameters = plan.parameters.size();
  table.metrics = metrics.size();
  table.header = {"run"};
  std::vector<Column> columns;
  for (std::size_t i = 0; i < values.size(); ++i) {
    columns.push_back(column_of(plan.parameters[i], values[i]));
    table.header.push_back(columns.back().heading);
  }
  table.header.insert(table.header.end(), metrics.begin(), metrics.end());
  table.header.insert(table.header.end(), {"state", "reason"});
  for (int run = 1; run <= runs; ++run) {
    const std::size_t index = static_cast<std::size_t>(run - 1);
    const RunResult& result = results[index];
    std::vector<std::string> row = {std::to_string(run)};
    for (const Column& column : columns) row.push_back(column.cells[index]);
    for (const std::string& metric : metrics) {
      const auto named = [&metric](const auto& one) { return one.first == metric; };
      const auto found = std::find_if(result.metrics.begin(), result.metrics.end(), named);
      const bool has = found != result.metrics.end() && !std::isnan(found->second);
      row.push_back(has ? fmt::format("{}", found->second) : "");
    }
    row.emplace_back(state_name(result.state));
    row.push_back(result.reason);
    table.rows.push_back(std::move(row));
    if (result.state == RunState::done) ++table.done;
    if (result.state == RunState::failed) ++table.failed;
    if (result.state == RunState::stopped) ++table.stopped;
    if (result.state == RunState::open) ++table.open;
  }
  return table;
}

void write_sweep(const SweepTable& table, const std::string& path) {
  std::string text = line_of(table.header);
  for (const std::vector<std::string>& row : table.rows) text += line_of(row);
  write_whole(path, text);
}

}  // namespace mpm_ros
