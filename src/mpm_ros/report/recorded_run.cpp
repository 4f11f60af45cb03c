#include "mpm_ros/report/recorded_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "mpm_ros/csv/csv_writer.hpp"

namespace mpm_ros {

std::vector<std::string> notes_on(const RecordedRun& run, bool cut_short) {
  std::vector<std::string> notes;
  const SolverState& last = run.statistics.last_state();
  if (cut_short) {
    notes.push_back(fmt::format(
        "the recording was cut short: this is what is whole in it, up to {:.4g} s{}; to repair it for good: rosbag "
        "reindex {}",
        last.time, run.scene.end ? fmt::format(" of {:.4g} s", *run.scene.end) : "", run.path));
    return notes;
  }
  if (last.failed) {
    notes.push_back(fmt::format("the run failed at {:.4g} s: {}", last.time, last.failure));
    return notes;
  }
  const double sync = run.info ? run.info->sync_period : 0.0;
  if (run.scene.end && last.time < *run.scene.end - 0.5 * sync) {
    // The last message of a run that ends in order carries the state's hash.
    notes.push_back(fmt::format("the recording ends at {:.4g} s, before the scene's end at {:.4g} s: {}", last.time,
                                *run.scene.end,
                                last.state_hash.empty() ? "it does not reach further" : "the run was stopped there"));
  }
  return notes;
}

std::vector<std::string> labels_of(const std::vector<std::string>& paths) {
  std::vector<std::string> labels;
  for (const std::string& path : paths) {
    const std::string stem = file_stem(std::filesystem::path(path).stem().string());  // names the run's folder, too
    std::string label = stem;
    for (int number = 2; std::find(labels.begin(), labels.end(), label) != labels.end(); ++number) {
      label = fmt::format("{}_{}", stem, number);
    }
    labels.push_back(label);
  }
  return labels;
}

}  // namespace mpm_ros
