#include "body_lattice.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/math/constants.hpp"
#include "mpm/scene/scene_parts.hpp"
#include "mpm/shape/ring.hpp"
#include "mpm/terrain/terrain.hpp"

namespace mpm {
namespace {

constexpr double kOnPlane = 1e-6;  ///< part of a spacing: 0.1 is not a binary number
constexpr int kPartsOfColumn = 4;  ///< parts of a spacing in which the depth of a terrain is asked for

bool on_plane(double place, double origin, double spacing) {
  const double planes = (place - origin) / spacing;
  return std::abs(planes - std::round(planes)) < kOnPlane;
}

/// The grid's own, with one position more on either side: Region::contains() decides.
Lattice grid_lattice(const Scene& scene, const Box& bounds, int axis) {
  const GridDefinition& grid = scene.definition.grid;
  const double spacing = particle_spacing(scene, axis);
  const double all = std::round((grid.max[axis] - grid.min[axis]) / spacing);
  const double first = std::floor((bounds.min[axis] - grid.min[axis]) / spacing) - 1.0;
  const double last = std::ceil((bounds.max[axis] - grid.min[axis]) / spacing) + 1.0;
  return {grid.min[axis], spacing, static_cast<std::int64_t>(std::max(0.0, first)),
          static_cast<std::int64_t>(std::min(all - 1.0, last)), false};
}

/// Between two faces as many particles as come nearest to the grid's spacing; more where their domains would be wider
/// than a cell, which the shape functions do not allow.
Lattice between(double low, double high, double spacing, double cell) {
  double count = std::max(1.0, std::round((high - low) / spacing));
  if ((high - low) / count > cell) count = std::ceil((high - low) / spacing - kOnPlane);
  return {low, (high - low) / count, 0, static_cast<std::int64_t>(count) - 1, true};
}

/// Along z of the ground below a terrain: up to its mean height where that is nearly the same everywhere, for then all
/// columns would be too high or too low alike; else what is cut off here is added there.
Lattice terrain_lattice(const Region& region, const Lattice& grid, double cell) {
  const Box bounds = region.bounds();
  const double depth = bounds.max.z() - bounds.min.z(), mean = depth * region.terrain->fullness();
  const bool level = depth - mean < 0.5 * grid.spacing;
  const bool at_bottom = on_plane(bounds.min.z(), grid.origin, grid.spacing);
  if (at_bottom && (!level || on_plane(bounds.min.z() + mean, grid.origin, grid.spacing))) return grid;
  Lattice own = between(bounds.min.z(), bounds.min.z() + mean, grid.spacing, cell);
  if (!level) own.spacing = grid.spacing;
  own.last = static_cast<std::int64_t>(std::ceil(depth / own.spacing));
  return own;
}

double terrain_volume(const Region& region, const std::array<Lattice, 3>& lattices, bool planar) {
  const Lattice &x = lattices[0], &y = lattices[1];
  const double bottom = region.bounds().min.z();
  const auto part = [](const Lattice& along, std::int64_t i, int k) {
    return along.origin + (static_cast<double>(i) + (k + 0.5) / kPartsOfColumn) * along.spacing;
  };
  const Box bounds = region.bounds();
  const auto outside = [&](int axis, double place) { return place < bounds.min[axis] || place >= bounds.max[axis]; };
  double sum = 0.0;
  for (std::int64_t j = y.first; j <= y.last; ++j) {
    for (int b = 0; b < (planar ? 1 : kPartsOfColumn); ++b) {
      const double at_y = planar ? 0.0 : part(y, j, b);
      if (!planar && outside(1, at_y)) continue;
      for (std::int64_t i = x.first; i <= x.last; ++i) {
        for (int a = 0; a < kPartsOfColumn; ++a) {
          const double at_x = part(x, i, a);
          if (!outside(0, at_x)) sum += std::max(0.0, region.terrain->height(at_x, at_y) - bottom);
        }
      }
    }
  }
  const double width = x.spacing / kPartsOfColumn;
  return sum * width * (planar ? 1.0 : y.spacing / kPartsOfColumn);
}

}  // namespace

std::array<Lattice, 3> body_lattice(const BodyDefinition& body, const Scene& scene) {
  std::array<Lattice, 3> lattices;
  lattices.fill({0.0, 0.0, 0, 0, false});
  const Region& region = body.region;
  const Box bounds = region.bounds();
  for (const int axis : axes_of(scene)) {
    Lattice& along = lattices[axis];
    along = grid_lattice(scene, bounds, axis);
    const double cell = scene.definition.grid.cell[axis];
    if (region.kind == Region::Kind::terrain && axis == 2) {
      along = terrain_lattice(region, along, cell);
      continue;
    }
    const bool flat_ends = region.kind == Region::Kind::box || region.kind == Region::Kind::terrain ||
                           (region.kind == Region::Kind::cylinder && (axis == region.axis || region.about_axis)) ||
                           scene.definition.geometry == GeometryKind::line;
    const double low = bounds.min[axis], high = bounds.max[axis];
    if (!flat_ends || (on_plane(low, along.origin, along.spacing) && on_plane(high, along.origin, along.spacing)))
      continue;
    along = between(low, high, along.spacing, cell);
  }
  return lattices;
}

double body_volume(const Region& region, const Scene& scene, const std::array<Lattice, 3>& lattices) {
  const GeometryKind geometry = scene.definition.geometry;
  const double across = scene.definition.across(), r = region.radius;
  if (region.kind == Region::Kind::terrain) return across * terrain_volume(region, lattices, planar(geometry));
  const Box bounds = region.bounds();
  const bool round = region.kind == Region::Kind::sphere && geometry != GeometryKind::line;
  if (round && (geometry == GeometryKind::solid || axisymmetric(geometry))) return 4.0 / 3.0 * kPi * r * r * r;
  if (round) return kPi * r * r * across;
  double volume = across;
  for (const int axis : axes_of(scene)) volume *= bounds.max[axis] - bounds.min[axis];
  if (axisymmetric(geometry)) volume *= 0.5 * kTurn * (bounds.min.x() + bounds.max.x());
  if (region.kind == Region::Kind::cylinder && geometry == GeometryKind::solid) volume *= 0.25 * kPi;
  return volume;
}

}  // namespace mpm
