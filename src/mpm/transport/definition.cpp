#include "mpm/transport/definition.hpp"

#include <algorithm>

namespace mpm {

double Property::between(double quantity) const {
  if (!(quantity > points_.front()[0])) return points_.front()[1];
  if (!(quantity < points_.back()[0])) return points_.back()[1];
  const auto above = std::upper_bound(points_.begin(), points_.end(), quantity,
                                      [](double q, const std::array<double, 2>& point) { return q < point[0]; });
  const std::array<double, 2>&low = *(above - 1), &high = *above;
  return low[1] + (high[1] - low[1]) * (quantity - low[0]) / (high[0] - low[0]);
}

double initial_value(const QuantityDefinition& quantity, const std::string& body, const Vec3& place) {
  const Function* start = nullptr;
  for (const auto& [name, function] : quantity.initial) {
    if (name == body || (name.empty() && start == nullptr)) start = &function;
  }
  return start != nullptr ? (*start)(0.0, place) : quantity.reference;
}

const QuantityDefinition* TransportDefinition::find(Transported quantity) const {
  for (const QuantityDefinition& one : quantities) {
    if (one.quantity == quantity) return &one;
  }
  return nullptr;
}

double Property::least() const {
  double least = points_.empty() ? constant_ : points_.front()[1];
  for (const auto& point : points_) least = std::min(least, point[1]);
  return least;
}

double Property::most() const {
  double most = points_.empty() ? constant_ : points_.front()[1];
  for (const auto& point : points_) most = std::max(most, point[1]);
  return most;
}

}  // namespace mpm
