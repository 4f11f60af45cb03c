#include "mpm_ros/node/sim_clock.hpp"

#include <rosgraph_msgs/Clock.h>

#include "mpm/math/nanoseconds.hpp"
#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {

namespace {

/// Times that a subscriber may fall behind before it loses some.
constexpr std::uint32_t kQueue = 1000;

}  // namespace

SimClock::SimClock(ros::NodeHandle node, bool publish, double rate)
    : period_(rate > 0.0 ? mpm::kNanosecondsOfSecond / rate : 0.0) {
  if (!ros::Time::isSimTime() || !publish) return;
  publisher_ = node.advertise<rosgraph_msgs::Clock>(topics::kClock, kQueue, true);
}

void SimClock::publish(std::int64_t time, const Stamps& stamps, bool always) {
  if (!publisher_) return;
  if (!always && published_ >= 0 && static_cast<double>(time - published_) < period_) return;
  published_ = time;
  rosgraph_msgs::Clock message;
  message.clock = stamps.at(time);
  publisher_.publish(message);
}

}  // namespace mpm_ros
