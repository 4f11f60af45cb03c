#include "mpm_ros/record/crack_outputs.hpp"

#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/markers.hpp"
#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {

void CrackOutputs::write() {
  written_at_ = simulation_.time();
  if (!simulation_.definition().cracks.any()) return;  // then nobody has a place for them
  if (!sinks_.wanted_anywhere(topics::kCracks) && !sinks_.wanted_anywhere(topics::kCrackMarkers)) return;
  const std::vector<mpm::CrackReport> cracks = simulation_.cracks();
  if (sinks_.wanted(topics::kCracks)) {
    Cracks message = to_message(cracks, simulation_.crack_tips());
    message.header = sinks_.header();
    sinks_.put(topics::kCracks, message);
  }
  if (!sinks_.wanted(topics::kCrackMarkers)) return;
  const std_msgs::Header header = sinks_.header();
  visualization_msgs::MarkerArray markers = crack_markers(cracks, header.frame_id, header.stamp);
  move_to(frame_, markers);
  sinks_.put(topics::kCrackMarkers, markers);
}

}  // namespace mpm_ros
