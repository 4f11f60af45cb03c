// Publishes the node's health on /diagnostics: once a second, and at once when there is news. Runs on the steady clock,
// since simulated time may stand still.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include <chrono>
#include <functional>
#include <mutex>

#include "mpm_ros/message/node_health.hpp"

namespace mpm_ros {

class NodeDiagnostics {
 public:
  /// On the node handle's callback queue. `every_second` is called there, too. `health` must outlive it.
  NodeDiagnostics(ros::NodeHandle& node, NodeHealth& health, std::function<void()> every_second);
  void stop() { timer_.stop(); }

 private:
  void look();

  NodeHealth& health_;
  const std::function<void()> every_second_;
  diagnostic_updater::Updater updater_;
  std::mutex looking_;
  std::chrono::steady_clock::time_point looked_at_;
  ros::SteadyTimer timer_;
};

}  // namespace mpm_ros
