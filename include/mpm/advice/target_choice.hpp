// Choices that a scene with `target` leaves: the cells that fit it, and the table of errors.
//
// A cell fits when the grid stays a whole number of cells along each axis and every face of a box, and the lower and
// side faces of ground from a map of heights, that lay on the lattice of particles lies on it again, so that these
// bodies do not change their size. Round bodies are filled as well as the cell allows. A height field from an
// expression without `cells` is evaluated at points that follow the cell, so its scene keeps the cell that it has.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "mpm/pace/force_errors.hpp"
#include "mpm/scene/scene.hpp"

namespace mpm {

/// Pairs of a cell [m] and particles along its edge, the scene's own first: cells from a quarter of its own to four
/// times as wide.
std::vector<std::pair<Vec3, int>> fitting_cells(const Scene& scene);

/// The kind of the scene's soil for the table of errors: clay if its materials that yield (drucker_prager,
/// mohr_coulomb, j2_plasticity) do so by cohesion alone, sand if one of them has friction; nothing where there are
/// none, since tools were measured in no others.
std::optional<pace::Ground> ground_of(const SimulationDefinition& definition);

/// Loads the table that the environment variable MPM_ROS_FORCE_ERRORS names, else config/force_errors.csv of the
/// package. @throws SceneError at `target` when it cannot be read
pace::ForceErrors load_force_errors(const Scene& scene);

}  // namespace mpm
