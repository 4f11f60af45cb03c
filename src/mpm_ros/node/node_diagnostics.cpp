#include "mpm_ros/node/node_diagnostics.hpp"

#include <stdexcept>
#include <utility>

namespace mpm_ros {

NodeDiagnostics::NodeDiagnostics(ros::NodeHandle& node, NodeHealth& health, std::function<void()> every_second)
    : health_(health), every_second_(std::move(every_second)), updater_(node) {
  updater_.setHardwareID("none");
  updater_.add("commands", [this](diagnostic_updater::DiagnosticStatusWrapper& s) { health_.fill_commands(s); });
  updater_.add("solver", [this](diagnostic_updater::DiagnosticStatusWrapper& s) { health_.fill_solver(s); });
  timer_ = node.createSteadyTimer(ros::WallDuration(0.1), [this](const ros::SteadyTimerEvent&) { look(); });
}

void NodeDiagnostics::look() {
  const std::unique_lock<std::mutex> lock(looking_, std::try_to_lock);
  if (!lock) return;
  const auto now = std::chrono::steady_clock::now();
  const bool due = now - looked_at_ >= std::chrono::seconds(1);
  if (due) {
    looked_at_ = now;
    every_second_();
  }
  if (!health_.take_news() && !due) return;
  try {
    updater_.force_update();
  } catch (const std::runtime_error&) {
    // A clock near the end of what a ros::Time holds: the updater's next time would be beyond.
  }
}

}  // namespace mpm_ros
