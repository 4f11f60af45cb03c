// The tools of a scene with a target, as the table of force errors judges them: what they do to which ground, how many
// cells lie across that, and whether such a tool was measured at all.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mpm/pace/force_errors.hpp"
#include "mpm/pace/rehearsal.hpp"
#include "mpm/scene/scene.hpp"

namespace mpm_ros {

struct JudgedTools {
  std::vector<mpm::pace::ToolInGround> all;  ///< at least one
  std::vector<std::string> names;            ///< names of their bodies; empty if no rehearsal found one in the ground
  std::string unknown;                       ///< case without a measured error, "a wheel in sand"; empty if none

  /// "0.021 m of 'rover', a wheel"
  std::string text() const;
};

/// Takes the tools that the rehearsal found, those that move if any does, or else what the scene says. One that was not
/// measured, or whose depth is not known, is judged by all that were measured in its ground, with cells counted across
/// the smallest tool's extent, and no error may be promised.
/// @param scene with a target
/// @throws mpm::SceneError for a target of an error that none can promise
JudgedTools judged_tools(const mpm::Scene& scene, const std::optional<mpm::pace::Rehearsal>& rehearsal,
                         const mpm::pace::ForceErrors& errors);

}  // namespace mpm_ros
