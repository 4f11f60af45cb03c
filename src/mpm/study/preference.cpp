#include "mpm/study/preference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mpm/study/method_choice.hpp"

namespace mpm::study {
namespace {

constexpr double kTie = 1.1;              // see the header
constexpr double kReferenceError = 0.01;  // that costs are relative to
const char* const kReference = "ugimp/usf/flip";

using Numbers = std::vector<std::optional<double>>;  // one a suite

/// Parts that differ from uGIMP, USAVG, FLIP, a shape function weighing more than an update, and that more than a
/// transfer.
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

/// The candidates that have a number everywhere, as factors over the least number that any candidate has on the suite.
std::vector<Standing> standings(const std::vector<std::string>& candidates, const std::vector<Numbers>& numbers,
                                bool factors) {
  std::vector<Standing> list;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto known = [](const std::optional<double>& number) { return number.has_value(); };
    if (!std::all_of(numbers[i].begin(), numbers[i].end(), known)) continue;
    Standing standing{candidates[i], {}, 0.0};
    for (std::size_t s = 0; s < numbers[i].size(); ++s) {
      double least = factors ? std::numeric_limits<double>::infinity() : 1.0;
      for (const Numbers& other : numbers) {
        if (factors && other[s]) least = std::min(least, *other[s]);
      }
      standing.by_suite.push_back(*numbers[i][s] / least);
      standing.worst = std::max(standing.worst, standing.by_suite.back());
    }
    list.push_back(std::move(standing));
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

std::optional<double> error_at(const std::vector<FrontPoint>& front, double cost) {
  if (front.empty() || cost < front.front().cost) return std::nullopt;
  if (cost >= front.back().cost) return front.back().error;
  const auto after =
      std::find_if(front.begin(), front.end(), [&](const FrontPoint& point) { return point.cost > cost; });
  const FrontPoint &a = *(after - 1), &b = *after;
  const double part = std::log(cost / a.cost) / std::log(b.cost / a.cost);
  return a.error * std::pow(b.error / a.error, part);
}

std::optional<Preference> prefer(const MethodCosts& costs, const std::vector<std::string>& suites,
                                 const std::vector<std::string>& candidates, const Budget& budget) {
  Preference preference;
  std::vector<std::string> left = candidates;
  for (const std::string& suite : suites) {
    const auto found = costs.find(suite);
    if (found == costs.end() || (budget.cost && !spending(found->second, *budget.cost))) continue;
    const auto measured = [&](const std::string& label) { return found->second.count(label) > 0; };
    if (std::any_of(candidates.begin(), candidates.end(), measured)) preference.suites.push_back(suite);
  }
  for (const std::string& suite : preference.suites) {
    const auto missing = [&](const std::string& label) { return costs.at(suite).count(label) == 0; };
    left.erase(std::remove_if(left.begin(), left.end(), missing), left.end());
  }
  if (preference.suites.empty() || left.empty()) return std::nullopt;

  std::vector<Numbers> numbers(left.size()), smallest(left.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    for (const std::string& suite : preference.suites) {
      const auto& methods = costs.at(suite);
      const std::vector<FrontPoint>& points = methods.at(left[i]);
      numbers[i].push_back(budget.cost ? error_at(points, *spending(methods, *budget.cost))
                                       : cost_at(points, *budget.error));
      smallest[i].push_back(points.back().error);
    }
  }
  preference.judged = budget.cost ? Judged::error_at_cost : Judged::cost;
  std::vector<Standing> list = standings(left, numbers, true);
  if (list.empty() && budget.error) {
    preference.judged = Judged::smallest_error;
    list = standings(left, smallest, false);
  }
  if (list.empty()) return std::nullopt;
  rank(list);
  preference.chosen = list.front();
  preference.others.assign(list.begin() + 1, list.end());
  return preference;
}

}  // namespace mpm::study
