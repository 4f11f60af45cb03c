// Outputs of the material in a scene's volumes. A scene without volumes has none.
#pragma once

#include "mpm_ros/record/output_sinks.hpp"

namespace mpm_ros {

class VolumeOutputs {
 public:
  /// Both must outlive it.
  VolumeOutputs(const mpm::Simulation& simulation, OutputSinks& sinks) : simulation_(simulation), sinks_(sinks) {}

  void write();

 private:
  const mpm::Simulation& simulation_;
  OutputSinks& sinks_;
};

}  // namespace mpm_ros
