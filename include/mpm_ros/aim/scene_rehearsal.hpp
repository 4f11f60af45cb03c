// The rehearsal of a scene before it is run (mpm/pace/rehearsal.hpp): on which grid, and for how long.
#pragma once

#include <functional>
#include <optional>

#include "mpm/pace/forecast.hpp"
#include "mpm/pace/rehearsal.hpp"
#include "mpm/scene/scene.hpp"

namespace mpm_ros {

/// Rehearses a scene whose first steps were timed, within a budget of wall time [s]: on cells four times as wide at
/// most, and, where that was quicker than it had to be, once more on finer ones, from which follows how much
/// would be awake in the run's own blocks. Returns nothing for a scene without an end or one that cannot be made
/// coarser.
/// @throws mpm::StoppedError
std::optional<mpm::pace::Rehearsal> rehearse_scene(const mpm::Scene& scene, const mpm::pace::Forecast& timed,
                                                   mpm::Isa isa, double budget, const std::function<bool()>& stop,
                                                   bool with_tools = false);

}  // namespace mpm_ros
