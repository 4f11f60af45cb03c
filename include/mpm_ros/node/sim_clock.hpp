// /clock: simulated time for the other nodes, when use_sim_time is set and nobody else owns the clock.
//
// Latched, so that a node that starts while time stands still (paused, between two steps) hears it at once and
// ros::Time::now() does not wait. Throttled in simulated time.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <cstdint>

#include "mpm_ros/message/stamps.hpp"

namespace mpm_ros {

class SimClock {
 public:
  /// Publishes nothing without use_sim_time, or when `publish` is false. `rate` [1/s simulated]; 0: no throttle.
  SimClock(ros::NodeHandle node, bool publish, double rate);

  /// Simulated time `time` [ns]; published when it is due, or `always`.
  void publish(std::int64_t time, const Stamps& stamps, bool always);
  /// A run begins: the next time is due whatever it is.
  void restart() { published_ = -1; }

 private:
  ros::Publisher publisher_;
  const double period_;          // [ns]
  std::int64_t published_ = -1;  // [ns] last time published
};

}  // namespace mpm_ros
