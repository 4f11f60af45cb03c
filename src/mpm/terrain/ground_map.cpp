#include "mpm/terrain/ground_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "mpm/scene/scene.hpp"
#include "mpm/terrain/height_file.hpp"
#include "mpm/terrain/terrain.hpp"

namespace mpm {
namespace {

constexpr double kWhole = 1e-6;  ///< part of a distance between points by which a domain may miss a whole number
/// A box that has grown further is of a grain that flies, and not of what fills a place.
constexpr double kMostGrown = 1.5;

Box room_of(const SimulationDefinition& definition) {
  Box room{definition.grid.min, definition.grid.max};
  if (planar(definition.geometry)) room.min.y() = 0.0, room.max.y() = definition.thickness;
  return room;
}

int points_along(const GridDefinition& grid, int axis, double resolution) {
  const double size = grid.max[axis] - grid.min[axis], count = std::round(size / resolution);
  if (count < 1.0 || std::abs(count * resolution - size) > kWhole * resolution) {
    throw Error(fmt::format("the domain is {:.6g} m along {}, which is no whole number of {:.6g} m; write {:.6g} m",
                            size, "xyz"[axis], resolution, size / std::max(count, 1.0)));
  }
  if (count > kGroundLimit.points) {
    throw Error(
        fmt::format("{:.0f} points along {} are more than {:.0f}, the most that {} may have; write a larger "
                    "resolution",
                    count, "xyz"[axis], kGroundLimit.points, kGroundLimit.of));
  }
  return static_cast<int>(count) + 1;
}

}  // namespace

double ground_resolution(const GridDefinition& grid) { return grid.cell.x(); }

GroundRaster ground_raster(const GridDefinition& grid, GeometryKind geometry, double resolution) {
  GroundRaster raster;
  raster.low = grid.min.head<2>();
  raster.resolution = resolution;
  raster.columns = points_along(grid, 0, resolution);
  if (planar(geometry)) {
    raster.low.y() = 0.0;
    return raster;
  }
  raster.rows = points_along(grid, 1, resolution);
  if (static_cast<double>(raster.columns) * raster.rows > kGroundLimit.points) {
    throw Error(fmt::format("{} x {} points are more than {:.0f}, the most that {} may have; write a larger resolution",
                            raster.columns, raster.rows, kGroundLimit.points, kGroundLimit.of));
  }
  return raster;
}

GroundRaster window_of(const GroundRaster& whole, const Vec2& centre, const Vec2& size) {
  GroundRaster window = whole;
  const auto choose = [&](int axis, int all, int& points) {
    points = std::clamp(static_cast<int>(std::lround(size[axis] / whole.resolution)) + 1, 1, all);
    const double begin = std::round((centre[axis] - 0.5 * size[axis] - whole.low[axis]) / whole.resolution);
    const double first = std::clamp(begin, 0.0, static_cast<double>(all - points));
    window.low[axis] = whole.low[axis] + first * whole.resolution;
  };
  choose(0, whole.columns, window.columns);
  if (whole.rows > 1) choose(1, whole.rows, window.rows);
  return window;
}

HeightGrid part_of(const HeightGrid& map, const GroundRaster& part) {
  HeightGrid found;
  found.low = part.low;
  found.high = part.low + part.resolution * Vec2(part.columns - 1, part.rows - 1);
  found.columns = part.columns;
  found.rows = part.rows;
  const auto column = std::lround((part.low.x() - map.low.x()) / part.resolution);
  const auto row = map.rows > 1 ? std::lround((part.low.y() - map.low.y()) / part.resolution) : 0;
  for (int j = 0; j < part.rows; ++j) {
    const auto from = map.heights.begin() + (row + j) * map.columns + column;
    found.heights.insert(found.heights.end(), from, from + part.columns);
  }
  return found;
}

GroundMap::GroundMap(const Simulation& simulation, const std::string& body)
    : axes_(planar(simulation.definition().geometry) ? 2 : 3),
      surface_(room_of(simulation.definition()), simulation.definition().grid.cell.z(),
               planar(simulation.definition().geometry)) {
  const SimulationDefinition& definition = simulation.definition();
  for (const DeformableBody& one : definition.bodies) {
    if (!body.empty() && one.name != body) continue;
    Body facts;
    std::tie(facts.first, facts.last) = simulation.body_ids(one.name);
    facts.half = 0.5 * definition.grid.cell / definition.method.particles_per_direction;
    if (one.lattice) facts.half = 0.5 * one.lattice->spacing;
    facts.volume = one.particle_volume;
    bodies_.push_back(facts);
  }
  if (bodies_.empty()) simulation.body_ids(body);  // throws
}

const HeightGrid& GroundMap::read(const Simulation& simulation, const GroundRaster& raster) {
  simulation.particle_field("x", x_);
  simulation.particle_field("y", y_);
  simulation.particle_field("z", z_);
  simulation.particle_field("volume", volume_);
  const Box room = room_of(simulation.definition());
  grains_.clear();
  for (const Body& body : bodies_) {
    for (std::size_t p = body.first; p < std::min(body.last, x_.size()); ++p) {
      const Vec3 centre(x_[p], axes_ == 2 ? room.center().y() : y_[p], z_[p]);
      // A run that has failed may have lost some.
      if (!room.contains(centre) || !(volume_[p] > 0.0) || !std::isfinite(volume_[p])) continue;
      const double size = std::min(std::pow(volume_[p] / body.volume, 1.0 / axes_), kMostGrown);
      grains_.push_back({centre, size * body.half, volume_[p]});
    }
  }
  return surface_.find(raster, grains_);
}

}  // namespace mpm
