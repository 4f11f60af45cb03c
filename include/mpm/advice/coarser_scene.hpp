// A scene on a coarser grid, for a run that shows in a short time what is to come in the long one (pace/rehearsal.hpp).
#pragma once

#include <optional>

#include "mpm/scene/scene.hpp"

namespace mpm {

struct CoarserScene {
  Scene scene;
  double times = 1.0;  ///< mean ratio of the cells' edges
};

/// The scene with cells about `times` as wide: along each axis a whole number of them fills the grid, three at least
/// where there are so many. Returns nothing where no cell is wider, or the scene cannot be read with such cells.
std::optional<CoarserScene> coarser_scene(const Scene& scene, double times);

}  // namespace mpm
