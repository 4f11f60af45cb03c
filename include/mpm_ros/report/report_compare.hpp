// Several runs side by side: a row a figure, a column a run.
#pragma once

#include <string>
#include <vector>

#include "mpm_ros/report/recorded_run.hpp"

namespace mpm_ros {

/// Shows what is in one run only (a body, a source of momentum) for that one, with a dash for the others.
std::string comparison(const std::vector<RecordedRun>& runs);

}  // namespace mpm_ros
