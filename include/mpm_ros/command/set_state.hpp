// States of bodies and robots that are set between two steps, or at the start of a run: as messages, and as overrides
// of a scene.
#pragma once

#include <mpm_ros/SetState.h>
#include <mpm_ros/StateSet.h>

#include <cstdint>
#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/state_set.hpp"
#include "mpm_ros/message/stamps.hpp"

namespace mpm_ros {

/// The state that a request asks for. `problem`: why it cannot be read.
mpm::StateSet read_state(const SetState::Request& request, const std::string& world_frame, std::string& problem);

/// As recorded and published; `effect` [ns].
StateSet to_message(const mpm::StateSet& state, std::int64_t effect, const std::string& world_frame,
                    const Stamps& stamps);
mpm::StateSet from_message(const StateSet& message);

/// Overrides of the scene with which robots begin so, at rest. `problem`: names the robot, joint or number that cannot
/// be, with the nearest name or the limits.
std::vector<std::string> start_overrides(const std::vector<StateSet>& robots, const mpm::Scene& scene,
                                         std::string& problem);

}  // namespace mpm_ros
