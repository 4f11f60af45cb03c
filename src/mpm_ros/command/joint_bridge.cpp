#include "mpm_ros/command/joint_bridge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "mpm/math/nanoseconds.hpp"
#include "mpm/math/nearest.hpp"
#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {
namespace {

constexpr std::uint32_t kMessages = 1000;  ///< messages that may wait for the thread that reads them

}  // namespace

JointBridge::JointBridge(ros::NodeHandle node, std::vector<mpm::RobotDefinition> robots, JointQueue& queue,
                         NodeHealth& health, bool latest, std::function<void()> heard)
    : queue_(queue), health_(health), latest_(latest), heard_(std::move(heard)), robots_(std::move(robots)) {
  for (int robot = 0; robot < static_cast<int>(robots_.size()); ++robot) {
    subscribe<sensor_msgs::JointState>(node, robot, topics::kJointCommand);
    subscribe<trajectory_msgs::JointTrajectory>(node, robot, topics::kJointTrajectory);
  }
}

template <typename Message>
void JointBridge::subscribe(ros::NodeHandle& node, int robot, const char* leaf) {
  const boost::function<void(const boost::shared_ptr<const Message>&)> take =
      [this, robot](const boost::shared_ptr<const Message>& message) { this->take(robot, *message); };
  subscribers_.push_back(node.subscribe<Message>(topics::of_robot(robots_[static_cast<std::size_t>(robot)].name, leaf),
                                                 kMessages, take, ros::VoidConstPtr(),
                                                 ros::TransportHints().tcpNoDelay()));
}

void JointBridge::begin(const std::vector<mpm::RobotDefinition>& robots, const Stamps& stamps) {
  const std::lock_guard<std::mutex> lock(mutex_);
  robots_ = robots;
  stamps_ = stamps;
}

void JointBridge::set_stamp(JointOrder& order) const {
  if (latest_ || order.requested.isZero()) return;
  order.stamp = std::max<std::int64_t>(stamps_.time_of(order.requested), 0);
}

void JointBridge::take(int robot, const sensor_msgs::JointState& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string problem;
  JointOrder order = read_order(message, robot, robots_.at(static_cast<std::size_t>(robot)), problem);
  set_stamp(order);
  push_or_refuse(topics::kJointCommand, std::move(order), problem);
}

void JointBridge::take(int robot, const trajectory_msgs::JointTrajectory& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string problem;
  JointOrder order = read_order(message, robot, problem);
  set_stamp(order);
  push_or_refuse(topics::kJointTrajectory, std::move(order), problem);
}

void JointBridge::push_or_refuse(const char* leaf, JointOrder order, const std::string& problem) {
  const std::string topic = topics::of_robot(robots_[static_cast<std::size_t>(order.robot)].name, leaf);
  if (!problem.empty()) {
    health_.refuse(fmt::format("a message on {}: {}", topic, problem));
  } else if (!queue_.push(std::move(order))) {
    health_.refuse(fmt::format("a message on {}: {} commands of joints wait already", topic, JointQueue::kMost));
  }
  heard_();
}

JointOrder JointBridge::read(const mpm_ros::JointCommand& message, std::string& problem) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::string> names;
  for (const mpm::RobotDefinition& robot : robots_) names.push_back(robot.name);
  const auto found = std::find(names.begin(), names.end(), message.robot);
  if (found == names.end()) {
    problem = fmt::format("there is no robot '{}'; {}", message.robot,
                          names.empty() ? "the scene has none" : mpm::suggest(message.robot, names));
    return {};
  }
  JointOrder order = read_order(message, static_cast<int>(found - names.begin()), problem);
  if (!problem.empty()) problem = fmt::format("the command for '{}': {}", message.robot, problem);
  return order;
}

}  // namespace mpm_ros
