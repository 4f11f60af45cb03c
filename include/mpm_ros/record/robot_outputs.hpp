// Outputs of a run's robots: joints as robot_state_publisher takes them, wrenches of sensors, and one message with all
// of it. A scene without robots has none.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mpm/definition/report.hpp"
#include "mpm/math/state_archive.hpp"
#include "mpm/robot/robot_report.hpp"
#include "mpm_ros/record/output_sinks.hpp"

namespace mpm_ros {

class RobotOutputs {
 public:
  /// Both must outlive it.
  RobotOutputs(const mpm::Simulation& simulation, OutputSinks& sinks) : simulation_(simulation), sinks_(sinks) {}

  /// Writes them with means since the last call, or since the start.
  void write();
  /// Writes them as they stand, with efforts and wrenches of the last step: where a run goes on from a checkpoint,
  /// whose means are under way, and where it failed between two sync points.
  void write_present();
  /// Poses of the base links, for tf: from there on robot_state_publisher has the links. Without those that are called
  /// as the world's frame is.
  std::vector<mpm::BodyState> bases(const std::string& world_frame) const;
  /// [ns] of the last call of write(), -1 before the first.
  std::int64_t written_at() const { return written_at_; }
  /// For checkpoints: impulses at the last call of write().
  void serialise(mpm::StateArchive& archive);

 private:
  void put(const std::vector<mpm::RobotReport>& now, const std::vector<mpm::RobotReport>& start, double interval);

  const mpm::Simulation& simulation_;
  OutputSinks& sinks_;
  std::vector<mpm::RobotReport> last_;  ///< at the last call of write(); empty before the first
  double time_ = 0.0;                   ///< time of it [s]
  std::int64_t written_at_ = -1;
};

}  // namespace mpm_ros
