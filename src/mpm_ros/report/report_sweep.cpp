#include "mpm_ros/report/report_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <tuple>

#include "mpm/math/json_text.hpp"
#include "mpm_ros/csv/csv_writer.hpp"
#include "mpm_ros/report/report_error.hpp"
#include "mpm_ros/report/report_plots.hpp"
#include "mpm_ros/report/report_tables.hpp"

namespace mpm_ros {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr int kMostRows = 40;  // rows of runs that are printed one by one

/// The number in a cell; NaN where there is none.
double cell_number(const std::string& cell) {
  double number = 0.0;
  const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  return error == std::errc() && stop == cell.data() + cell.size() ? number : kNone;
}

std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&values](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t i = begin; i < end; ++i) ranks[order[i]] = 0.5 * static_cast<double>(begin + end - 1);
    begin = end;
  }
  return ranks;
}

std::string cell_text(const std::string& cell) {
  const double value = cell_number(cell);
  return std::isnan(value) ? cell : number(value);
}

std::string run_rows(const SweepTable& table) {
  if (table.runs() > kMostRows)
    return fmt::format("\nRuns: more than {}; sweep.csv, or --csv, has them one by one\n", kMostRows);
  TextTable text({table.header.begin(), table.header.end() - 1});
  for (const std::vector<std::string>& row : table.rows) {
    std::vector<std::string> cells;
    for (std::size_t i = 0; i + 1 < row.size(); ++i) cells.push_back(cell_text(row[i]));
    text.add(std::move(cells));
  }
  return "\nRuns\n" + text.text();
}

std::string metric_rows(const std::vector<SweepMetric>& metrics) {
  if (metrics.empty()) return "";
  TextTable text({"metric", "least", "in run", "mean", "largest", "in run"});
  for (const SweepMetric& metric : metrics) {
    text.add({metric.name, number(metric.least), metric.least_run, number(metric.mean), number(metric.largest),
              metric.largest_run});
  }
  return "\nMetrics of the runs that are done\n" + text.text();
}

std::string correlation_rows(const SweepTable& table, const std::vector<SweepMetric>& metrics) {
  if (metrics.empty()) return "";
  std::vector<std::string> header = {"metric"};
  for (std::size_t i = 0; i < table.parameters; ++i) header.push_back(table.header[1 + i]);
  TextTable text(header);
  for (const SweepMetric& metric : metrics) {
    std::vector<std::string> row = {metric.name};
    for (const double value : metric.correlation) row.push_back(std::isnan(value) ? "-" : fmt::format("{:.2f}", value));
    text.add(std::move(row));
  }
  return "\nRank correlation with parameters: 1 rises with it, -1 falls, 0 neither\n" + text.text();
}

std::string failures(const SweepTable& table) {
  std::string text;
  for (const std::vector<std::string>& row : table.rows) {
    if (!row.back().empty()) text += fmt::format("  run {} {}: {}\n", row.front(), row[row.size() - 2], row.back());
  }
  return text.empty() ? text : "\nRuns that did not come to their end\n" + text;
}

nlohmann::ordered_json json_of(const std::string& folder, const SweepTable& table,
                               const std::vector<SweepMetric>& metrics) {
  nlohmann::ordered_json json;
  json["schema"] = 1;
  json["sweep"] = folder;
  json["runs"] = table.runs();
  json["done"] = table.done;
  json["failed"] = table.failed;
  json["stopped"] = table.stopped;
  json["open"] = table.open;
  json["metrics"] = nlohmann::ordered_json::object();
  for (const SweepMetric& metric : metrics) {
    nlohmann::ordered_json& one = json["metrics"][metric.name];
    one = {{"min", metric.least}, {"mean", metric.mean}, {"max", metric.largest}};
    one["correlation"] = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < table.parameters; ++i) one["correlation"][table.header[1 + i]] = metric.correlation[i];
  }
  json["table"] = nlohmann::ordered_json::array();
  for (const std::vector<std::string>& row : table.rows) {
    nlohmann::ordered_json one;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const bool word = i + 2 >= row.size() || (!row[i].empty() && std::isnan(cell_number(row[i])));
      one[table.header[i]] = word ? nlohmann::ordered_json(row[i]) : nlohmann::ordered_json(cell_number(row[i]));
    }
    one["run"] = json["table"].size() + 1;
    json["table"].push_back(std::move(one));
  }
  return json;
}

void check_sweep_options(const ReportOptions& options) {
  if (options.bags.size() > 1) throw ReportError(fmt::format("{}: is a sweep; report it alone", options.bags.front()));
  const bool bag_only = options.same || !options.animate.empty() || !options.field.empty() || options.tolerance ||
                        !options.name_space.empty();
  if (bag_only) {
    throw ReportError(
        fmt::format("{}: is a sweep, for which there are --csv, --json, --plots and --check; for more, "
                    "name the bag of a run",
                    options.bags.front()));
  }
}

}  // namespace

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> x = ranks_of(a), y = ranks_of(b);
  const double mean = 0.5 * (static_cast<double>(a.size()) - 1.0);
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean) * (x[i] - mean);
    yy += (y[i] - mean) * (y[i] - mean);
    xy += (x[i] - mean) * (y[i] - mean);
  }
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : kNone;
}

std::vector<SweepMetric> metrics_of(const SweepTable& table) {
  std::vector<SweepMetric> metrics;
  for (std::size_t column = 1 + table.parameters; column < 1 + table.parameters + table.metrics; ++column) {
    SweepMetric metric;
    metric.name = table.header[column];
    std::vector<double> values;
    std::vector<const std::vector<std::string>*> rows;
    for (const std::vector<std::string>& row : table.rows) {
      const double value = cell_number(row[column]);
      if (std::isnan(value) || row[row.size() - 2] != state_name(RunState::done)) continue;
      if (values.empty() || value < metric.least) std::tie(metric.least, metric.least_run) = std::tie(value, row[0]);
      if (values.empty() || value > metric.largest)
        std::tie(metric.largest, metric.largest_run) = std::tie(value, row[0]);
      values.push_back(value);
      rows.push_back(&row);
    }
    if (values.empty()) continue;
    metric.mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    for (std::size_t i = 0; i < table.parameters; ++i) {
      std::vector<double> parameter;
      for (const auto* row : rows) parameter.push_back(cell_number((*row)[1 + i]));
      const bool numbers = std::none_of(parameter.begin(), parameter.end(), [](double x) { return std::isnan(x); });
      metric.correlation.push_back(numbers ? rank_correlation(parameter, values) : kNone);
    }
    metrics.push_back(std::move(metric));
  }
  return metrics;
}

bool report_sweep(const ReportOptions& options, std::ostream& out) {
  check_sweep_options(options);
  const Study study(options.bags.front());
  const SweepTable table = read_sweep(study);
  const std::vector<SweepMetric> metrics = metrics_of(table);
  const bool only_json = options.json == "-";
  if (!options.json.empty()) {
    const std::string text = mpm::json_text(json_of(study.folder(), table, metrics), 2) + "\n";
    if (only_json) {
      out << text << std::flush;
    } else {
      write_whole(options.json, text);
    }
  }
  if (!only_json) {
    out << fmt::format("{}: {} runs, {}\n", study.folder(), table.runs(), table.counts()) << run_rows(table)
        << metric_rows(metrics) << correlation_rows(table, metrics) << failures(table);
  }
  if (!options.csv.empty()) {
    make_csv_folder(options.csv);
    write_sweep(table, options.csv + "/sweep.csv");
    if (!only_json) out << "\ntable     " << options.csv << "/sweep.csv\n";
  }
  if (!options.plots.empty()) {
    if (metrics.empty())
      throw ReportError(
          fmt::format("--plots: no run of {} has a metric to draw; name some in the scene", study.folder()));
    const TemporaryFolder temporary;
    write_sweep(table, temporary.file("sweep.csv"));
    make_sweep_plots(temporary.file("sweep.csv"), table.parameters, table.metrics, options.plots);
    if (!only_json) out << "pictures  " << options.plots << "\n";
  }
  return !options.check || table.done == table.runs();
}

}  // namespace mpm_ros
