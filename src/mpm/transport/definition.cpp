#include "mpm/transport/definition.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mpm {
namespace {

/// A bound on the largest principal value.
double largest(const Symmetric3<double>& s) {
  return std::max({s.xx, s.yy, s.zz}) + std::abs(s.yz) + std::abs(s.xz) + std::abs(s.xy);
}

}  // namespace

double least_capacity(const TransportMaterial& material, Transported quantity, double density) {
  return material.capacity.least() * (traits_of(quantity).by_mass ? density : 1.0);
}

double largest_diffusivity(const TransportMaterial& material, Transported quantity, double density) {
  const double turn = material.anisotropy ? largest(*material.anisotropy) : 1.0;
  return material.conductivity.most() * turn / least_capacity(material, quantity, density);
}

double stable_step(double cell, double diffusivity) {
  return diffusivity > 0.0 ? cell * cell / (4.0 * diffusivity) : std::numeric_limits<double>::infinity();
}

double surface_conductance(const FluxDefinition& flux, double most) {
  if (flux.kind == FluxDefinition::Kind::convection) return flux.coefficient;
  if (flux.kind != FluxDefinition::Kind::radiation) return 0.0;
  const double hottest = flux.value.is_constant() ? std::max(most, flux.value(0.0)) : most;
  return 4.0 * flux.coefficient * kStefanBoltzmann * std::pow(hottest, 3);
}

double longest_update(double cell, double least_capacity, double conductance) {
  return conductance > 0.0 ? least_capacity * cell / (2.0 * conductance) : std::numeric_limits<double>::infinity();
}

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
