// What a scene with `target` leaves to be chosen: the cells that fit it, and the scene with a choice in it.
//
// A cell fits when the grid stays a whole number of cells along each axis and every face of a deformable box that lay
// on the lattice of particles lies on it again, so that no body changes its size. The recorded text of a scene for
// which a choice was made has it in its keys and, as `target.chosen`, beside them; read again, it is not chosen anew.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mpm/pace/force_errors.hpp"
#include "mpm/scene/scene.hpp"

namespace mpm {

/// Pairs of a cell [m] and particles along its edge, the scene's own first: cells from a quarter of its own to four
/// times as wide.
std::vector<std::pair<Vec3, int>> fitting_cells(const Scene& scene);

/// Why a scene is not its own mirror image across the middle of its grid along an axis, or cannot be halved there, and
/// what to do; empty where the half can be modelled. What the shapes of rigid bodies look like is left to the scene,
/// but for their extents.
std::string asymmetry(const Scene& scene, int axis);
/// What leaves the half above that plane, "key=value": grid, boxes of bodies, and a plane of symmetry as the lower
/// face. Forces are then those of the half. @param scene without asymmetry
std::vector<std::string> half_lines(const Scene& scene, int axis);

/// The scene with `lines`, "key=value", set in it and recorded as the choice of its target, with what is expected of
/// it. @throws SceneError when a line does not fit
Scene with_chosen(const Scene& scene, const std::vector<std::string>& lines, double expected_pace,
                  double expected_error);
/// The scene with the choice that `recorded`, the text of a run of it, has; as it is when it has no target, was chosen
/// already, or when `recorded` has another target or none. @throws SceneError
Scene with_recorded_choice(const Scene& scene, const std::string& recorded);
/// The text of a scene without its target: what its steps cost depends on.
std::string text_without_target(const Scene& scene);

/// Loads the table that the environment variable MPM_ROS_FORCE_ERRORS names, else config/force_errors.csv of the
/// package. @throws SceneError at `target` when it cannot be read
pace::ForceErrors load_force_errors(const Scene& scene);

}  // namespace mpm
