#include "study/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <ostream>
#include <tuple>

#include "mpm/choice/front.hpp"

namespace mpm::study {
namespace {

constexpr double kTargets[] = {0.1, 0.03, 0.01, 0.003};
const char* const kReferenceMethod = "ugimp/usf/flip";

struct Measure {
  const char* name;
  double Row::*column;
};
constexpr Measure kMeasures[] = {{"work", &Row::work}, {"cost", &Row::cost}};

std::string cell_of(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

Cheapest cheapest(const std::string& suite, double target, const Measure& measure,
                  const std::map<std::string, std::vector<choice::FrontPoint>>& points) {
  std::vector<std::pair<double, std::string>> found;
  Cheapest line;
  line.suite = suite;
  line.target = target;
  line.by = measure.name;
  for (const auto& [method, of_method] : points) {
    const auto cost = choice::cost_at(choice::front(of_method), target);
    if (!cost) continue;
    found.emplace_back(*cost, method);
    if (method == kReferenceMethod) line.reference = *cost;
  }
  std::sort(found.begin(), found.end());
  for (const auto& one : found) line.reached_by.push_back(one.second);
  if (!found.empty()) std::tie(line.value, line.method) = found[0];
  if (found.size() > 1) std::tie(line.second_value, line.second) = found[1];
  return line;
}

}  // namespace

std::vector<Cheapest> summarise(const std::vector<Row>& rows) {
  std::vector<std::string> order;
  for (const Row& row : rows) {
    if (std::find(order.begin(), order.end(), row.suite) == order.end()) order.push_back(row.suite);
  }
  std::vector<Cheapest> lines;
  for (const std::string& suite : order) {
    for (const Measure& measure : kMeasures) {
      std::map<std::string, std::vector<choice::FrontPoint>> points;
      for (const Row& row : rows) {
        if (row.suite == suite && row.status == "ok") points[row.method].push_back({row.*measure.column, row.error});
      }
      for (const double target : kTargets) lines.push_back(cheapest(suite, target, measure, points));
    }
  }
  return lines;
}

void write_summary(std::ostream& out, const std::vector<Cheapest>& lines) {
  out << "suite,target_error,by,method,value,second,second_value,ugimp_usf_value,reached_by\n";
  for (const Cheapest& line : lines) {
    std::string reached;
    for (const std::string& method : line.reached_by) reached += (reached.empty() ? "" : " ") + method;
    out << quoted(line.suite) << ',' << cell_of(line.target) << ',' << line.by << ',' << quoted(line.method) << ','
        << cell_of(line.value) << ',' << quoted(line.second) << ',' << cell_of(line.second_value) << ','
        << cell_of(line.reference) << ',' << quoted(reached) << '\n';
  }
}

}  // namespace mpm::study
