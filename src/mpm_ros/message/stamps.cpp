#include "mpm_ros/message/stamps.hpp"

namespace mpm_ros {

ros::Time Stamps::at(std::int64_t time) const {
  ros::Time stamp;
  stamp.fromNSec(origin_.toNSec() + static_cast<std::uint64_t>(time));
  return stamp.isZero() ? ros::TIME_MIN : stamp;
}

std::int64_t Stamps::time_of(const ros::Time& stamp) const {
  // The stamp that stands for time zero, see above.
  if (origin_.isZero() && stamp == ros::TIME_MIN) return 0;
  return static_cast<std::int64_t>(stamp.toNSec()) - static_cast<std::int64_t>(origin_.toNSec());
}

}  // namespace mpm_ros
