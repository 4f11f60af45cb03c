// Poses of the links of a robot whose joints are at given positions.
#pragma once

#include <vector>

#include "mpm/robot/definition.hpp"

namespace mpm {

/// Poses of all links at the start, in the model's order.
std::vector<Pose> start_poses(const RobotDefinition& robot);

}  // namespace mpm
