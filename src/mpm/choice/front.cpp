#include "mpm/choice/front.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::choice {

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

std::optional<double> error_at(const std::vector<FrontPoint>& front, double cost) {
  if (front.empty() || cost < front.front().cost) return std::nullopt;
  if (cost >= front.back().cost) return front.back().error;
  const auto after =
      std::find_if(front.begin(), front.end(), [&](const FrontPoint& point) { return point.cost > cost; });
  const FrontPoint &a = *(after - 1), &b = *after;
  const double part = std::log(cost / a.cost) / std::log(b.cost / a.cost);
  return a.error * std::pow(b.error / a.error, part);
}

}  // namespace mpm::choice
