// One run of a study: its process, and its result from what the process left.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "mpm/sweep/plan.hpp"
#include "mpm_ros/sweep/study.hpp"
#include "mpm_ros/sweeping/run_process.hpp"

namespace mpm_ros {

/// Options for the start of each run of a sweep.
struct SweepRunOptions {
  std::string program;  ///< run_scene
  int threads = 1;
  std::string isa = "auto";
};

class SweepRun {
 public:
  /// Starts the run in its folder, whose lock it holds from now on. @throws MachineError
  SweepRun(const Study& study, const mpm::sweep::Plan& plan, int run, FileLock lock, const SweepRunOptions& options);

  int number() const { return run_; }
  /// Nothing while it runs; then its result, which is kept in the study. @throws SweepError, MachineError
  std::optional<RunResult> end();

 private:
  /// Result, by its files and the end of its process. @throws MachineError
  RunResult result_of(const ProcessEnd& end) const;

  const Study& study_;
  const mpm::sweep::Plan& plan_;
  int run_;
  FileLock lock_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  RunProcess process_;
};

}  // namespace mpm_ros
