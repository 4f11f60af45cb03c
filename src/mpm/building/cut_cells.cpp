#include "cut_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "mpm/math/constants.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/scene/scene_parts.hpp"
#include "mpm/terrain/terrain.hpp"

namespace mpm {
namespace {

constexpr double kWhole = 1e-9;  ///< part of a place: a share is that near to none or all of it
/// Share of a place from which on it has a particle of its own wherever its centre is. It is no round number, for where
/// surfaces cut places by one, round-off would decide.
constexpr double kLeast = 0.0957;
constexpr double kSame = 1e-6;       ///< part of a spacing: places that are equally near
constexpr double kLeastReach = 0.1;  ///< times that of a whole place; the most is kMostSurface

/// Parts along an axis in which what lies in a body is found.
int parts_along(std::size_t axes) { return axes == 3 ? 4 : 8; }

bool has_curved_side(const Region& region, const Scene& scene) {
  if (scene.definition.geometry == GeometryKind::line) return false;
  return region.kind == Region::Kind::sphere || region.kind == Region::Kind::terrain ||
         (region.kind == Region::Kind::cylinder && !region.about_axis);
}

using Number = std::array<std::int64_t, 3>;

std::int64_t key(const Number& number) { return place_key(number[0], number[1], number[2]); }

/// The part of a place that lies in the body.
struct Part {
  double share;  ///< share of a place
  Vec3 centre;
};

/// Parts of the particles beside the surface, by place_key().
using Parts = std::unordered_map<std::int64_t, std::vector<Part>>;

class Cutting {
 public:
  Cutting(const Region& region, const Scene& scene, const std::array<Lattice, 3>& lattices)
      : region_(region), lattices_(lattices), axes_(axes_of(scene)) {}
  /// Finds the parts that each particle beside the surface gets.
  Parts parts(StopCheck& check_stop) const;
  /// Makes the particle of a place that has these parts.
  FilledPlace sum(std::int64_t key, const std::vector<Part>& given) const;

 private:
  Vec3 centre_of(const Number& number) const;
  /// True of a place that has a particle; `parts`: of those that are cut.
  bool holds(const Number& number, const Parts& parts) const;
  /// True where the body would reach if its curved surface were farther out.
  bool is_between_ends(const Vec3& point) const;
  /// True in the outermost places at a flat end of a cylinder: there the whole box meets a tool, so that the end is
  /// flat.
  bool is_at_end(const Vec3& point) const;
  /// Finds the distance to the curved surface, negative inside [m], and the normal out of the body.
  double distance(const Vec3& point, Vec3& normal) const;
  Part part_of(const Vec3& centre) const;
  /// Places beside one that take a part of it with this centre.
  std::vector<Number> takers(const Number& number, const Vec3& centre, const Parts& parts) const;

  const Region& region_;
  const std::array<Lattice, 3>& lattices_;
  std::vector<int> axes_;
};

Parts Cutting::parts(StopCheck& check_stop) const {
  double diagonal = 0.0;
  for (const int axis : axes_) diagonal += std::pow(0.5 * lattices_[axis].spacing, 2);
  diagonal = std::sqrt(diagonal);
  Parts parts;
  const Lattice &x = lattices_[0], &y = lattices_[1], &z = lattices_[2];
  std::vector<std::pair<Number, Part>> outside;
  for (std::int64_t k = z.first; k <= z.last; ++k) {
    for (std::int64_t j = y.first; j <= y.last; ++j) {
      for (std::int64_t i = x.first; i <= x.last; ++i) {
        check_stop();
        const Number number{i, j, k};
        const Vec3 centre = centre_of(number);
        Vec3 normal;
        if (!is_between_ends(centre) || std::abs(distance(centre, normal)) > diagonal) continue;
        const Part part = part_of(centre);
        if (part.share < kWhole) continue;
        if (part.share < kLeast && !region_.contains(centre)) {
          outside.emplace_back(number, part);
        } else if (part.share < 1.0 - kWhole) {
          parts[key(number)].push_back(part);
        }
      }
    }
  }
  for (const auto& [number, part] : outside) {
    const std::vector<Number> beside = takers(number, part.centre, parts);
    for (const Number& taker : beside) {
      std::vector<Part>& given = parts[key(taker)];
      if (given.empty()) given.push_back({1.0, centre_of(taker)});
      given.push_back({part.share / static_cast<double>(beside.size()), part.centre});
    }
  }
  return parts;
}

FilledPlace Cutting::sum(std::int64_t key, const std::vector<Part>& given) const {
  FilledPlace place{Vec3::Zero(), 0.0};
  for (const Part& part : given) {
    place.part += part.share;
    place.centre += part.share * part.centre;
  }
  place.centre /= place.part;
  // With parts of others it may lie just beyond its place, by which particles are found again.
  const Vec3 middle = centre_of(place_number(key));
  for (const int axis : axes_) {
    const double most = (0.5 - kSame) * lattices_[axis].spacing;
    place.centre[axis] = std::clamp(place.centre[axis], middle[axis] - most, middle[axis] + most);
  }
  if (is_at_end(place.centre)) return place;
  Vec3 normal;
  const double depth = -distance(place.centre, normal);
  double reach = 0.0;
  for (const int axis : axes_) reach += std::pow(0.5 * lattices_[axis].spacing * normal[axis], 2);
  place.surface = std::clamp(depth / std::sqrt(reach), kLeastReach, kMostSurface);
  return place;
}

Vec3 Cutting::centre_of(const Number& number) const {
  return {lattices_[0].center(number[0]), lattices_[1].center(number[1]), lattices_[2].center(number[2])};
}

bool Cutting::holds(const Number& number, const Parts& parts) const {
  if (parts.count(key(number)) > 0) return true;
  for (int axis = 0; axis < 3; ++axis) {
    if (number[axis] < lattices_[axis].first || number[axis] > lattices_[axis].last) return false;
  }
  return region_.contains(centre_of(number));
}

bool Cutting::is_between_ends(const Vec3& point) const {
  if (region_.about_axis && point.x() < 0.0) return false;
  if (region_.kind == Region::Kind::cylinder) {
    const double along = point[region_.axis] - region_.center[region_.axis];
    return along >= -0.5 * region_.height && along < 0.5 * region_.height;
  }
  if (region_.kind != Region::Kind::terrain) return true;
  const Box bounds = region_.terrain->bounds();
  for (const int axis : axes_) {
    if (point[axis] < bounds.min[axis] || (axis != 2 && point[axis] >= bounds.max[axis])) return false;
  }
  return true;
}

bool Cutting::is_at_end(const Vec3& point) const {
  if (region_.kind != Region::Kind::cylinder || axes_.size() < 3) return false;
  const double along = std::abs(point[region_.axis] - region_.center[region_.axis]);
  return along > 0.5 * region_.height - lattices_[region_.axis].spacing;
}

double Cutting::distance(const Vec3& point, Vec3& normal) const {
  if (region_.kind == Region::Kind::terrain) {
    // The plane that touches the surface above the point, over a spacing.
    const auto height = [&](double x, double y) { return region_.terrain->height(x, y); };
    const Box bounds = region_.terrain->bounds();
    normal = Vec3::UnitZ();
    for (const int axis : axes_) {
      if (axis == 2) continue;
      Vec3 low = point, high = point;
      // The map may have no height beyond its first and last points here, which count as of the next of its cells.
      const double slack = kSame * lattices_[axis].spacing;
      low[axis] = std::max(point[axis] - 0.5 * lattices_[axis].spacing, bounds.min[axis] + slack);
      high[axis] = std::min(point[axis] + 0.5 * lattices_[axis].spacing, bounds.max[axis] - slack);
      normal[axis] = -(height(high.x(), high.y()) - height(low.x(), low.y())) / (high[axis] - low[axis]);
    }
    const double length = normal.norm();
    normal /= length;
    return (point.z() - height(point.x(), point.y())) / length;
  }
  Vec3 arm = point - region_.center;
  for (int axis = 0; axis < 3; ++axis) {
    const bool across = std::find(axes_.begin(), axes_.end(), axis) == axes_.end();
    if (across || (region_.kind == Region::Kind::cylinder && axis == region_.axis)) arm[axis] = 0.0;
  }
  const double radius = arm.norm();
  normal = radius > 0.0 ? Vec3(arm / radius) : Vec3(Vec3::Unit(axes_.front()));
  return radius - region_.radius;
}

// The share of each part of a place is that of a layer of its width along the normal, cut by the surface's plane there.
Part Cutting::part_of(const Vec3& centre) const {
  const int parts = parts_along(axes_.size());
  std::array<int, 3> count{1, 1, 1};
  Vec3 width = Vec3::Zero();
  int all = 1;
  for (const int axis : axes_) {
    count[axis] = parts;
    width[axis] = lattices_[axis].spacing / parts;
    all *= parts;
  }
  Part sum{0.0, Vec3::Zero()};
  for (int n = 0; n < all; ++n) {
    const std::array<int, 3> at{n % count[0], n / count[0] % count[1], n / (count[0] * count[1])};
    Vec3 place = centre;
    for (const int axis : axes_) place[axis] += (at[axis] + 0.5 - 0.5 * count[axis]) * width[axis];
    Vec3 normal;
    const double outward = distance(place, normal);
    const double layer = normal.cwiseAbs().dot(width);
    const double share = std::clamp(0.5 - outward / layer, 0.0, 1.0);
    if (share == 0.0) continue;
    sum.share += share;
    sum.centre += share * (place - 0.5 * (1.0 - share) * layer * normal);
  }
  if (sum.share > 0.0) sum.centre /= sum.share;
  sum.share /= all;
  return sum;
}

std::vector<Number> Cutting::takers(const Number& number, const Vec3& centre, const Parts& parts) const {
  double least = kInfinity, spacing = kInfinity;
  for (const int axis : axes_) spacing = std::min(spacing, lattices_[axis].spacing);
  std::vector<Number> nearest;
  for (int crossed = 1; crossed <= static_cast<int>(axes_.size()) && nearest.empty(); ++crossed) {
    for (int n = 0; n < 27; ++n) {
      const std::array<int, 3> step{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
      const Number beside{number[0] + step[0], number[1] + step[1], number[2] + step[2]};
      if (std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]) != crossed || !holds(beside, parts)) continue;
      const double away = (centre_of(beside) - centre).norm();
      if (away > least + kSame * spacing) continue;
      if (away < least - kSame * spacing) nearest.clear();
      least = std::min(least, away);
      nearest.push_back(beside);
    }
  }
  return nearest;
}

}  // namespace

CutCells::CutCells(const Region& region, const Scene& scene, const std::array<Lattice, 3>& lattices,
                   StopCheck& check_stop) {
  if (!has_curved_side(region, scene)) return;
  const Cutting cutting(region, scene, lattices);
  for (const auto& [at, given] : cutting.parts(check_stop)) cut_.emplace(at, cutting.sum(at, given));
}

}  // namespace mpm
