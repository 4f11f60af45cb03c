// Checkpoints of run_scene: when a run saves itself, and the scene that a resumed one has.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>

#include "mpm/scene/scene.hpp"
#include "mpm_ros/run/run.hpp"
#include "mpm_ros/run/run_scene.hpp"

namespace mpm_ros {

/// The scene of `options`, or that of the checkpoint to be resumed where none is named. @throws mpm::Error
mpm::Scene scene_of(const RunSceneOptions& options);

/// The scene as the checkpoint's run has it: with its sync period, and with what was chosen for its target, if it has
/// one.
/// @throws mpm::CheckpointError where it is another scene, or has another target, than that run
mpm::Scene with_choice_of(const mpm::Scene& scene, const std::string& path);

/// Has the run go on from the checkpoint, with the instruction set that it was made with unless another is asked for.
/// @throws mpm::CheckpointError
void resume_from(const std::string& path, RunOptions& options);

/// Sentence on how a run whose state is lost goes on. `last`: its last checkpoint, or empty. `how`: how one is resumed.
std::string after_loss(const std::string& last, const std::string& how);

/// Names of files beside a checkpoint: while it is written, and of the state of a failure.
std::string part_of_checkpoint(const std::string& path);
std::string failed_checkpoint(const std::string& path);

class RunSceneCheckpoints {
 public:
  /// Over several ranks all have one, and its calls are collective.
  /// @throws mpm::SceneError for options that make no sense, or a file that cannot be written
  RunSceneCheckpoints(const RunSceneOptions& options, std::int64_t sync_period);

  /// Call after each sync period. If a file cannot be written, `err` gets a line and the run goes on.
  void at_sync(Run& run, std::ostream& err);
  /// Call when the run has ended or was stopped. @throws mpm::CheckpointError
  void at_end(Run& run, std::ostream& out);
  /// The run has failed. The file of the last good state stays; that of the failure has _failed in its name. Over
  /// several ranks there is none: the others may not know of the failure. Where the state is lost the last good one is
  /// named instead.
  void at_failure(Run& run, const std::string& reason, std::ostream& err);

 private:
  /// Makes the file and removes it again; `ranks`: null for a process that is alone. Collective.
  /// @throws mpm::SceneError where it cannot be written, or is not the same on all ranks
  void try_path(mpm::Communicator* ranks) const;
  /// @throws mpm::SceneError
  void make(const std::string& part) const;
  std::string path_;
  std::string last_;  ///< file of the last good state; empty: there is none yet
  bool over_ranks_ = false;
  std::int64_t period_ = 0;  ///< [ns]; 0: at the end alone
};

}  // namespace mpm_ros
