// A sweep: a plan of many runs laid out in a folder, and run, each in a process of its own, as many at once as the
// machine carries. What has a result is not run again; several sweeps, on several machines, share a folder.
#pragma once

#include <functional>
#include <ostream>
#include <string>

namespace mpm_ros {

struct RunSweepOptions {
  std::string plan;          ///< a plan, or the folder of a study that has been laid out
  std::string out;           ///< folder of the study; empty: the plan's name without its ending, in this folder
  std::string program;       ///< run_scene
  int jobs = -1;             ///< runs at once; 0: lay out only; -1: as many as cores and memory carry
  int only = 0;              ///< run of a laid-out study to make, alone; 0: all
  int threads = 1;           ///< threads of each run
  std::string isa = "auto";  ///< instruction set of each run
};

/// Result of a sweep, as an exit code.
enum class RunSweepResult {
  done = 0,
  not_all = 1,  ///< stopped, no room on the disk, or other processes have runs under way
  bad_input = 2,
  some_failed = 3
};

/// Lays the study out and runs it. What there is to tell goes to `out`, progress and errors to `err`; `bar`: progress
/// as a bar that is drawn over and over (a terminal).
RunSweepResult run_sweep(const RunSweepOptions& options, std::ostream& out, std::ostream& err, bool bar,
                         const std::function<bool()>& stop_requested);

}  // namespace mpm_ros
