#include "mpm_ros/record/output_sinks.hpp"

#include <utility>

#include "mpm_ros/message/bag_error.hpp"
#include "mpm_ros/record/together.hpp"

namespace mpm_ros {

std_msgs::Header OutputSinks::header(const std::string& frame) const {
  std_msgs::Header header;
  header.stamp = stamp();
  header.frame_id = frame;
  return header;
}

void OutputSinks::end_writing() {
  together<BagError>(simulation_.ranks(), [this] {
    if (failed_) std::rethrow_exception(std::exchange(failed_, nullptr));
  });
}

}  // namespace mpm_ros
