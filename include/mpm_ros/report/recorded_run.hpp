// A bag and all that one pass over it tells: what tables, JSON and comparisons are made from.
#pragma once

#include <string>
#include <vector>

#include "mpm_ros/report/report_bag.hpp"
#include "mpm_ros/report/report_check.hpp"
#include "mpm_ros/report/report_scene.hpp"
#include "mpm_ros/report/report_statistics.hpp"

namespace mpm_ros {

struct RecordedRun {
  std::string path;
  std::string label;  ///< tells it from the others of a report
  std::string name_space;
  std::optional<RunInfo> info;
  SceneFacts scene;
  std::vector<std::string> particle_fields;
  RunStatistics statistics;
  std::vector<std::string> gaps;    ///< in time, at most ten
  std::vector<CheckResult> checks;  ///< empty unless asked for
  std::vector<std::string> notes;   ///< notes that a reader should know before the figures: cut short, ended early, …

  /// "half_sine", or the bag's path when the scene is not known.
  const std::string& scene_name() const { return info && !info->scene.empty() ? info->scene : path; }
};

/// Notes on a run that is read: cut short, ended before the scene's end, snapshots missing.
std::vector<std::string> notes_on(const RecordedRun& run, bool cut_short);

/// A label for each path, all different: the file's name without its ending, fit for a folder's name, with a number
/// where two have the same.
std::vector<std::string> labels_of(const std::vector<std::string>& paths);

}  // namespace mpm_ros
