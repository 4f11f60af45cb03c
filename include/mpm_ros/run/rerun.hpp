// Contents of a recording that a run needs to be made again: the scene's text, the commands at their effect times, how
// far it went and which state it reached.
#pragma once

#include <mpm_ros/Command.h>
#include <mpm_ros/JointCommand.h>
#include <mpm_ros/RunInfo.h>

#include <cstdint>
#include <string>
#include <vector>

#include "mpm/implicit/sweep_budget.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm_ros/message/bag_error.hpp"

namespace mpm_ros {

struct Rerun {
  std::string bag;  ///< path
  RunInfo info;
  std::vector<mpm_ros::Command> commands;
  std::vector<mpm_ros::JointCommand> joint_commands;
  std::vector<mpm_ros::StateSet> states_set;
  std::int64_t end = 0;            ///< [ns] simulated time of the last state recorded
  std::string state_hash;          ///< hash of the last state that was recorded with one; empty: none was
  std::int64_t hashed_at = 0;      ///< [ns] its time
  std::vector<mpm::CutStep> cuts;  ///< steps whose sweeps time.budget ended
  bool failed = false;             ///< the physics failed after `end`
};

/// Reads the bag and the parts after it.
/// `resumed`: it is run again from a checkpoint, and need not begin at the run's start.
/// @throws BagError when it cannot be read, tells no scene, or does not begin at the run's start
Rerun read_rerun(const std::string& bag, bool resumed = false);
/// That of the first rank, on all. Collective; `ranks`: null for a process that is alone.
Rerun rerun_of_first(mpm::Communicator* ranks, Rerun own);
/// Number of processes that computed the run.
int recorded_ranks(const RunInfo& info);

/// Name of the device that took the steps; empty: the processor did.
std::string recorded_device(const RunInfo& info);

/// Check that a run that is made again is the recorded one, to the bit.
class RerunCheck {
 public:
  explicit RerunCheck(const Rerun& rerun) : rerun_(rerun) {}
  /// Notes what makes it another run, so that nothing is compared.
  void differs(const std::string& why) { differences_.push_back(why); }
  /// After each sync period, and after a failure.
  void look(const mpm::Simulation& simulation);
  /// Verdict in one line.
  std::string verdict() const;
  /// False when another state was reached than the recorded one.
  bool passed() const { return !comparable() || hash_ == rerun_.state_hash; }

 private:
  bool comparable() const { return differences_.empty() && !rerun_.state_hash.empty(); }

  const Rerun& rerun_;
  std::vector<std::string> differences_;
  std::string hash_;  ///< hash of the state where one was recorded; empty: not reached
};

}  // namespace mpm_ros
