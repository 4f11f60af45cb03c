// Making of a run of the node's scene from its parameters.
#pragma once

#include <string>
#include <vector>

#include "mpm/math/files_in_use.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm_ros/node/node_parameters.hpp"
#include "mpm_ros/run/run.hpp"

namespace mpm_ros {

/// `number`: of the run, from 1; it names the bag. `topics_below`: namespace of the topics in it. `set`: what a reset
/// has set in the scene, for the record.
RunOptions run_options(const mpm::Scene& scene, const NodeParameters& parameters, int number,
                       const std::string& topics_below, const std::vector<std::string>& set = {});

/// Checks that need all of them together: no recording over what is read, particle fields that there are, a clock that
/// can be set back. @throws ParameterError
void check(const NodeParameters& parameters, const RunOptions& options, const mpm::Scene& scene);

/// Files of the scene, of the commands that are to be repeated, and of the record: for the names of further
/// files. `record`: the bag of the run, or empty.
mpm::FilesInUse files_of(const NodeParameters& parameters, const mpm::Scene& scene, const std::string& record);

}  // namespace mpm_ros
