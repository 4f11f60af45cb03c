// The ground of a run as a map of heights: its particles, as the boxes that they fill, through GroundSurface.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mpm/simulation/simulation.hpp"
#include "mpm/terrain/ground_surface.hpp"

namespace mpm {

/// Distance between points of a map where a scene says none: the edge of a cell [m].
double ground_resolution(const GridDefinition& grid);
/// Points over the whole domain, the first and the last at its ends. `resolution` [m].
/// @throws Error where the domain is not a whole number of it along an axis, or there would be too many points
GroundRaster ground_raster(const GridDefinition& grid, GeometryKind geometry, double resolution);
/// The points of `whole` in a window of a size [m] around `centre`, shifted to lie within it.
GroundRaster window_of(const GroundRaster& whole, const Vec2& centre, const Vec2& size);
/// The heights of a part of a map. `part`: of the raster that the map has.
HeightGrid part_of(const HeightGrid& map, const GroundRaster& part);

class GroundMap {
 public:
  /// `body`: a deformable body that alone is ground; all where it is empty. @throws DefinitionError for an unknown one
  GroundMap(const Simulation& simulation, const std::string& body);

  /// Heights over a raster. Collective over several ranks; the first one gets them, the others a map of NaN.
  const HeightGrid& read(const Simulation& simulation, const GroundRaster& raster);

 private:
  /// Facts that the particles of a body have in common.
  struct Body {
    std::size_t first = 0, last = 0;  ///< rows of its particles, by id
    Vec3 half = Vec3::Zero();         ///< half edges of a whole particle's box at the start [m]
    double volume = 0.0;              ///< the same [m^3]
  };
  std::vector<Body> bodies_;
  int axes_;  ///< along which boxes grow with their volume
  GroundSurface surface_;
  std::vector<double> x_, y_, z_, volume_;
  std::vector<GroundGrain> grains_;
};

}  // namespace mpm
