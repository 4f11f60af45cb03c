// The folder of a sweep, and what is known of its runs. doc/sweeps.md lists the files.
//
//   STUDY/plan.yaml, scene.yaml          the plan and its scene, from which the study can be laid out again
//   STUDY/runs/0001/scene.yaml           the scene of the run, with all that the plan sets
//   STUDY/runs/0001/result.json          how it ended; there only when it has ended, and then whole
//   STUDY/runs/0001/log.txt, summary.json, run.bag, csv/, vtk/
//   STUDY/sweep.csv                      parameters against metrics
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mpm/math/error.hpp"

namespace mpm_ros {

/// A study that cannot be read or written.
class SweepError : public mpm::Error {
 public:
  using mpm::Error::Error;
};

/// The machine failed, as a full disk does: the sweep ends, and goes on when that is mended.
class MachineError : public SweepError {
 public:
  using SweepError::SweepError;
};

enum class RunState {
  open,     ///< has no result
  done,     ///< came to its end
  failed,   ///< ended with a failure that would come again: of the physics, a crash
  stopped,  ///< was ended from outside, or something around it was in the way: it is run again
};
const char* state_name(RunState state);

/// End of a run.
struct RunResult {
  RunState state = RunState::open;
  std::vector<std::pair<std::string, std::string>> parameters;  ///< settings of the plan in this run, by path
  std::string reason;                                           ///< reason if neither open nor done, one sentence
  std::vector<std::pair<std::string, double>> metrics;          ///< the scene's; NaN for one without a value
  std::string state_hash;                                       ///< empty when it did not come to its end
  double wall_seconds = 0.0;                                    ///< from start to end of its process
  /// Nothing more is to be computed.
  bool final() const { return state == RunState::done || state == RunState::failed; }
};

class Study {
 public:
  /// Reads and writes nothing.
  explicit Study(std::string folder) : folder_(std::move(folder)) {}

  const std::string& folder() const { return folder_; }
  std::string plan() const { return folder_ + "/plan.yaml"; }
  std::string scene() const { return folder_ + "/scene.yaml"; }
  std::string table() const { return folder_ + "/sweep.csv"; }
  std::string lock() const { return folder_ + "/lock"; }
  /// STUDY/runs/0017
  std::string of_run(int run) const;
  std::string of_run(int run, const std::string& file) const { return of_run(run) + "/" + file; }
  /// True if it has been laid out: it has a plan, and the lock that tells it from a folder with somebody's plan.
  bool there() const;
  /// Runs that it was laid out with: the highest number of a folder in runs/.
  int runs() const;
  /// An open one where there is no result. @throws SweepError for one that cannot be read
  RunResult result(int run) const;
  /// Whole or not at all, also when the machine fails meanwhile. @throws MachineError
  void keep(int run, const RunResult& result) const;

 private:
  std::string folder_;
};

/// True if `path` is the folder of a study.
bool is_study(const std::string& path);

/// Writes a file under another name, and gives it its own when all of it is on the disk: a reader finds the old one or
/// the new one. @throws MachineError
void write_whole(const std::string& path, const std::string& text);
/// The text of a file; nothing when it cannot be read.
std::optional<std::string> read_whole(const std::string& path);

/// A file that one process at a time holds, on this machine or on another that shares the disk. Processes that it
/// starts hold it too, where they are given the descriptor, and it is free when the last of them has ended, however.
/// Weak: disks that are mounted without locks between machines (Lustre without `flock`) have them on each alone.
class FileLock {
 public:
  /// Nothing when another process holds it. @throws MachineError
  static std::optional<FileLock> try_take(const std::string& path);
  /// Waits for it. @throws MachineError
  static FileLock take(const std::string& path);
  ~FileLock();
  FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FileLock& operator=(FileLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  int descriptor() const { return descriptor_; }

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

}  // namespace mpm_ros
