#include "mpm/choice/preference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mpm/choice/method_choice.hpp"

namespace mpm::choice {
namespace {

constexpr double kTie = 1.1;              // see the header
constexpr double kReferenceError = 0.01;  // that costs are relative to
const char* const kReference = "ugimp/usf/flip";

/// Parts that differ from uGIMP, USAVG, FLIP; then which.
std::array<int, 4> complexity(const std::string& label) {
  const MethodDefinition method = find_method(label).method;
  const int shape = method.shape != ShapeKind::ugimp, update = method.update != UpdateScheme::usavg;
  const int transfer = transfer_label(method.transfer) != "flip";
  return {shape + update + transfer, shape, update, transfer};
}

/// Spending on a suite; nothing where the reference has no run.
std::optional<double> spending(const std::map<std::string, std::vector<FrontPoint>>& methods, double times) {
  const auto reference = methods.find(kReference);
  if (reference == methods.end() || reference->second.empty()) return std::nullopt;
  return times * cost_at(reference->second, kReferenceError).value_or(reference->second.back().cost);
}

/// Numbers of all candidates on one suite, before they are made relative; nothing for who has none.
struct Column {
  JudgedSuite suite;
  std::vector<std::optional<double>> numbers;

  /// Takes the least number, but not below `floor`, as the unit.
  void relate(double floor = 0.0) {
    suite.least = std::numeric_limits<double>::infinity();
    for (const auto& number : numbers) suite.least = std::min(suite.least, number.value_or(suite.least));
    suite.least = std::max(suite.least, floor);
    for (auto& number : numbers) {
      if (number) *number = std::max(*number / suite.least, 1.0);
    }
  }
  bool empty() const {
    return std::none_of(numbers.begin(), numbers.end(), [](const auto& number) { return number.has_value(); });
  }
};

/// The candidates that have a number on every suite.
std::vector<Standing> standings(const std::vector<std::string>& candidates, const std::vector<Column>& columns) {
  std::vector<Standing> list;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Standing standing{candidates[i], {}, 0.0};
    for (const Column& column : columns) {
      if (!column.numbers[i]) break;
      standing.by_suite.push_back(*column.numbers[i]);
      standing.worst = std::max(standing.worst, *column.numbers[i]);
    }
    if (standing.by_suite.size() == columns.size()) list.push_back(std::move(standing));
  }
  return list;
}

/// Moves the chosen one to the front; the others stand by their worst suite.
void rank(std::vector<Standing>& list) {
  std::stable_sort(list.begin(), list.end(), [](const Standing& a, const Standing& b) { return a.worst < b.worst; });
  const double tied = kTie * list.front().worst;
  auto chosen = list.begin();
  for (auto other = list.begin(); other != list.end() && other->worst <= tied; ++other) {
    if (complexity(other->method) < complexity(chosen->method)) chosen = other;
  }
  std::rotate(list.begin(), chosen, chosen + 1);
}

}  // namespace

std::optional<Preference> prefer(const MethodCosts& costs, const std::vector<std::string>& suites,
                                 const std::vector<std::string>& candidates, const Budget& budget) {
  std::vector<std::string> left = candidates, counted;
  for (const std::string& suite : suites) {
    const auto found = costs.find(suite);
    if (found == costs.end() || (budget.cost && !spending(found->second, *budget.cost))) continue;
    const auto measured = [&](const std::string& label) { return found->second.count(label) > 0; };
    if (std::any_of(candidates.begin(), candidates.end(), measured)) counted.push_back(suite);
  }
  for (const std::string& suite : counted) {
    const auto missing = [&](const std::string& label) { return costs.at(suite).count(label) == 0; };
    left.erase(std::remove_if(left.begin(), left.end(), missing), left.end());
  }
  if (counted.empty() || left.empty()) return std::nullopt;

  std::vector<Column> columns, smallest;
  for (const std::string& suite : counted) {
    const auto& methods = costs.at(suite);
    Column asked{{suite, budget.cost ? Judged::error_at_cost : Judged::cost, 0.0}, {}};
    Column error{{suite, Judged::smallest_error, 0.0}, {}};
    for (const std::string& label : left) {
      const std::vector<FrontPoint>& points = methods.at(label);
      asked.numbers.push_back(budget.cost ? error_at(points, *spending(methods, *budget.cost))
                                          : cost_at(points, *budget.error));
      error.numbers.emplace_back(points.back().error);
    }
    smallest.push_back(error);
    columns.push_back(budget.error && asked.empty() ? error : asked);
    columns.back().relate();
  }
  std::vector<Standing> list = standings(left, columns);
  if (list.empty() && budget.error) {
    columns = smallest;
    for (Column& column : columns) column.relate(*budget.error);
    list = standings(left, columns);
  }
  if (list.empty()) return std::nullopt;
  rank(list);
  Preference preference;
  for (const Column& column : columns) preference.suites.push_back(column.suite);
  preference.chosen = list.front();
  preference.others.assign(list.begin() + 1, list.end());
  return preference;
}

}  // namespace mpm::choice
