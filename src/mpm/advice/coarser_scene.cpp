#include "mpm/advice/coarser_scene.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/advice/target_record.hpp"
#include "mpm/pace/discretisation.hpp"

namespace mpm {

namespace {

constexpr double kFewest = 3.0;  ///< cells along an axis

}  // namespace

std::optional<CoarserScene> coarser_scene(const Scene& scene, double times) {
  const GridDefinition& grid = scene.definition.grid;
  const GeometryKind geometry = scene.definition.geometry;
  const pace::Discretisation own = pace::discretisation_of(scene.definition);
  pace::Discretisation coarse = own;
  double product = 1.0;
  for (const int axis : axes_of(geometry)) {
    const double length = grid.max[axis] - grid.min[axis], cells = std::round(length / grid.cell[axis]);
    const double fewer = std::clamp(std::round(cells / times), std::min(kFewest, cells), cells);
    if (fewer == cells) continue;
    coarse.cell[axis] = length / fewer;
    product *= coarse.cell[axis] / own.cell[axis];
  }
  if (coarse.cell == own.cell) return std::nullopt;
  CoarserScene found;
  found.times = std::pow(product, 1.0 / dimensions(geometry));
  try {
    found.scene = parse_scene(text_without_target(scene), scene.path, pace::set_lines(coarse, own, geometry));
  } catch (const SceneError&) {
    return std::nullopt;
  }
  found.scene.definition.time.end = scene.definition.time.end;  // as --end has it
  return found;
}

}  // namespace mpm
