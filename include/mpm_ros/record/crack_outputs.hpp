// Outputs of explicit cracks: a message, and lines for displays. A scene without cracks has none.
#pragma once

#include <cstdint>

#include "mpm_ros/message/local_frame.hpp"
#include "mpm_ros/record/output_sinks.hpp"

namespace mpm_ros {

class CrackOutputs {
 public:
  /// All must outlive it.
  CrackOutputs(const mpm::Simulation& simulation, OutputSinks& sinks, const LocalFrame& frame)
      : simulation_(simulation), sinks_(sinks), frame_(frame) {}

  /// Collective over several ranks.
  void write();
  /// [ns] of the last call, -1 before the first.
  std::int64_t written_at() const { return written_at_; }

 private:
  const mpm::Simulation& simulation_;
  OutputSinks& sinks_;
  const LocalFrame& frame_;
  std::int64_t written_at_ = -1;
};

}  // namespace mpm_ros
