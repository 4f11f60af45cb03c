#include "mpm/bed/kept_ground.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

constexpr double kOnPlane = 1e-6;  ///< part of a spacing: 0.1 is not a binary number

/// Numbers of the places along an axis whose centres may lie between two bounds.
std::array<long, 2> places_between(double low, double high, double origin, double spacing) {
  if (!(spacing > 0.0)) return {0, 0};
  return {std::lround(std::floor((low - origin) / spacing - 0.5)),
          std::lround(std::ceil((high - origin) / spacing - 0.5))};
}

}  // namespace

std::vector<KeptGround::Stack> KeptGround::stacks_of(int column, int node) const {
  const Vec3 origin = source_.origin(), spacing = source_.spacing();
  const Box box = columns_.bounds_of_node(column, node);
  const auto x = places_between(box.min.x(), box.max.x(), origin.x(), spacing.x());
  const auto y = places_between(box.min.y(), box.max.y(), origin.y(), spacing.y());
  const auto centre = [](double from, double size, long i) { return from + (static_cast<double>(i) + 0.5) * size; };
  const long bottom = std::lround(std::ceil((source_.bottom() - origin.z()) / spacing.z() - kOnPlane));
  std::vector<Stack> stacks;
  for (long i = x[0]; i <= x[1]; ++i) {
    for (long j = y[0]; j <= y[1]; ++j) {
      const double at_y = spacing.y() > 0.0 ? centre(origin.y(), spacing.y(), j) : 0.0;
      const Vec3 place(centre(origin.x(), spacing.x(), i), at_y, source_.bottom());
      if (!columns_.holds(place) || columns_.of_point(place) != column || columns_.node_of(place) != node) continue;
      stacks.push_back({place.x(), place.y(), bottom});
    }
  }
  return stacks;
}

void KeptGround::stack(int column, double particle_mass, std::size_t first, GroundParticles& ground) {
  const auto found = masses_.find(column);
  if (found == masses_.end()) return;
  const Vec3 origin = source_.origin(), spacing = source_.spacing();
  const std::size_t end = ground.positions.size();
  for (int node = 0; node < BedColumns::kNodes; ++node) {
    double& mass = found->second[node];
    if (mass < 0.5 * particle_mass) continue;
    std::vector<Stack> stacks = stacks_of(column, node);
    for (std::size_t p = first; p < end && !stacks.empty(); ++p) {
      const Vec3& place = ground.positions[p];
      const auto under = std::find_if(stacks.begin(), stacks.end(), [&](const Stack& one) {
        const double half = 0.5 + kOnPlane;
        return std::abs(one.x - place.x()) <= half * spacing.x() && std::abs(one.y - place.y()) <= half * spacing.y();
      });
      if (under == stacks.end()) continue;
      under->next = std::max(under->next, std::lround(std::floor((place.z() - origin.z()) / spacing.z())) + 1);
    }
    while (mass >= 0.5 * particle_mass && !stacks.empty()) {
      const auto lowest = std::min_element(stacks.begin(), stacks.end(),
                                           [](const Stack& a, const Stack& b) { return a.next < b.next; });
      const double z = origin.z() + (static_cast<double>(lowest->next++) + 0.5) * spacing.z();
      if (z > ceiling_) break;
      ground.positions.emplace_back(lowest->x, lowest->y, z);
      if (source_.cuts()) {
        ground.parts.push_back(1.0);
        ground.surfaces.push_back(1.0);
      }
      mass -= particle_mass;
    }
  }
}

double KeptGround::mass() const {
  double sum = 0.0;
  for (const auto& [column, masses] : masses_) {
    for (const double mass : masses) sum += mass;
  }
  return sum;
}

void KeptGround::serialise(StateArchive& archive) {
  std::vector<int> columns;
  std::vector<double> all;
  for (const auto& [column, masses] : masses_) {
    columns.push_back(column);
    all.insert(all.end(), masses.begin(), masses.end());
  }
  archive.list("columns", columns);
  archive.list("masses", all);
  if (!archive.reading()) return;
  masses_.clear();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(i * BedColumns::kNodes), BedColumns::kNodes,
                masses_[columns[i]].begin());
  }
}

void KeptGround::hashed(std::vector<double>& numbers) const {
  for (const auto& [column, masses] : masses_) {
    numbers.push_back(column);
    numbers.insert(numbers.end(), masses.begin(), masses.end());
  }
}

}  // namespace mpm
