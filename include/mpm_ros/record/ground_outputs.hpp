// Outputs of the ground: its heights as a map, a cloud and an image, when they are due and have changed enough. A scene
// that asks for no maps has none.
#pragma once

#include <cstdint>
#include <optional>

#include "mpm_ros/message/local_frame.hpp"
#include "mpm_ros/record/ground_record.hpp"
#include "mpm_ros/record/output_sinks.hpp"

namespace mpm_ros {

class GroundOutputs {
 public:
  /// All must outlive it. @throws mpm::Error as GroundRecord
  GroundOutputs(const mpm::Simulation& simulation, OutputSinks& sinks, const LocalFrame& frame,
                const std::optional<mpm::GroundOutput>& ground);

  /// At the present sync point.
  bool due() const { return record_ && record_->due(simulation_.time()); }
  /// `all`: whether or not the ground has changed. Collective over several ranks.
  void write(bool all);
  /// [ns] of the last call of write(), -1 before the first.
  std::int64_t written_at() const { return written_at_; }
  /// For checkpoints.
  void serialise(mpm::StateArchive& archive);

 private:
  const mpm::Simulation& simulation_;
  OutputSinks& sinks_;
  const LocalFrame& frame_;
  std::optional<GroundRecord> record_;
  std::int64_t written_at_ = -1;
};

}  // namespace mpm_ros
