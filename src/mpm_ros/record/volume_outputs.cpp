#include "mpm_ros/record/volume_outputs.hpp"

#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {

void VolumeOutputs::write() {
  if (simulation_.definition().volumes.empty() || !sinks_.wanted(topics::kVolumes)) return;
  Volumes message = to_message(simulation_.volumes());
  message.header = sinks_.header();
  sinks_.put(topics::kVolumes, message);
}

}  // namespace mpm_ros
