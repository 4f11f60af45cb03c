// Simulated time [ns since the run's start] and the stamps of messages.
//
// A stamp is the run's origin plus simulated time. With use_sim_time, and offline, the origin is zero; else it is the
// wall time at which the run started. Nothing is stamped zero, which means "none" or "latest" to ROS and is refused
// by rosbag: simulated time zero with origin zero is stamped ros::TIME_MIN, one nanosecond.
#pragma once

#include <ros/time.h>

#include <cstdint>

namespace mpm_ros {

class Stamps {
 public:
  /// Origin zero.
  Stamps() = default;
  explicit Stamps(const ros::Time& origin) : origin_(origin) {}

  const ros::Time& origin() const { return origin_; }
  /// Stamp of simulated time `time` >= 0 [ns]; at least ros::TIME_MIN.
  ros::Time at(std::int64_t time) const;
  /// Simulated time of a stamp [ns]; negative for a stamp before the run's start.
  std::int64_t time_of(const ros::Time& stamp) const;

 private:
  ros::Time origin_;
};

}  // namespace mpm_ros
