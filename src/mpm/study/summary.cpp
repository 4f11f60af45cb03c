#include "mpm/study/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <tuple>

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
                  const std::map<std::string, std::vector<FrontPoint>>& points) {
  std::vector<std::pair<double, std::string>> found;
  Cheapest line;
  line.suite = suite;
  line.target = target;
  line.by = measure.name;
  for (const auto& [method, of_method] : points) {
    const auto cost = cost_at(front(of_method), target);
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

std::vector<FrontPoint> front(std::vector<FrontPoint> points) {
  points.erase(std::remove_if(points.begin(), points.end(),
                              [](const FrontPoint& point) {
                                return !(point.cost > 0.0 && point.error > 0.0 && std::isfinite(point.cost) &&
                                         std::isfinite(point.error));
                              }),
               points.end());
  std::sort(points.begin(), points.end(), [](const FrontPoint& a, const FrontPoint& b) {
    return a.cost != b.cost ? a.cost < b.cost : a.error < b.error;
  });
  std::vector<FrontPoint> result;
  for (const FrontPoint& point : points) {
    if (result.empty() || point.error < result.back().error) result.push_back(point);
  }
  return result;
}

std::optional<double> cost_at(const std::vector<FrontPoint>& front, double error) {
  if (front.empty() || front.back().error > error) return std::nullopt;
  if (front.front().error <= error) return front.front().cost;
  const auto after =
      std::find_if(front.begin(), front.end(), [&](const FrontPoint& point) { return point.error <= error; });
  const FrontPoint &a = *(after - 1), &b = *after;
  const double part = std::log(error / a.error) / std::log(b.error / a.error);
  return a.cost * std::pow(b.cost / a.cost, part);
}

std::vector<Cheapest> summarise(const std::vector<Row>& rows) {
  std::vector<std::string> order;
  for (const Row& row : rows) {
    if (std::find(order.begin(), order.end(), row.suite) == order.end()) order.push_back(row.suite);
  }
  std::vector<Cheapest> lines;
  for (const std::string& suite : order) {
    for (const Measure& measure : kMeasures) {
      std::map<std::string, std::vector<FrontPoint>> points;
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
