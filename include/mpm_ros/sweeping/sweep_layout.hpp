// A plan laid out as a study: every scene read and built before the first run, and written to the folder of its run.
#pragma once

#include <functional>
#include <string>

#include "mpm_ros/sweep/study.hpp"

namespace mpm_ros {

struct LaidOut {
  int runs = 0;
  double memory = 0.0;       ///< memory of the largest run, at least [bytes]
  bool has_metrics = false;  ///< true if a run's scene has any
};

/// The study of a plan, or of a folder that holds one. `out` names its folder where it is not that of the plan.
Study study_of(const std::string& plan, const std::string& out);

/// Lays `plan` out, or again: runs that have a result keep it. `told`: asked before each run with the part that is
/// done; true ends it. @throws mpm::Error for a bad plan, a bad scene, or a study of another plan
LaidOut lay_out(const std::string& plan, const Study& study, const std::function<bool(double)>& told);

}  // namespace mpm_ros
