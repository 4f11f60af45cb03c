#include "mpm_ros/command/command_bridge.hpp"

#include <fmt/format.h>
#include <ros/master.h>

#include "mpm/math/nearest.hpp"
#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {

namespace {

constexpr std::uint32_t kQueue = 1000;

}  // namespace

CommandBridge::CommandBridge(ros::NodeHandle node, const std::vector<std::string>& bodies,
                             const std::vector<std::string>& frames, const std::string& world_frame,
                             CommandQueue& queue, NodeHealth& health)
    : prefix_(node.resolveName(topics::kBodies) + "/"),
      health_(health),
      listener_(frames_),
      reader_(bodies, world_frame, prefix_, frames_, queue, health),
      follower_(frames, world_frame, frames_, reader_, health) {
  for (int body = 0; body < static_cast<int>(bodies.size()); ++body) {
    reader_.set_frame(body, frames[static_cast<std::size_t>(body)]);
    subscribe<geometry_msgs::Twist>(node, body, topics::kCmdVel);
    subscribe<geometry_msgs::TwistStamped>(node, body, topics::kCmdVelStamped);
    subscribe<geometry_msgs::Wrench>(node, body, topics::kCmdWrench);
    subscribe<geometry_msgs::WrenchStamped>(node, body, topics::kCmdWrenchStamped);
    subscribe<geometry_msgs::PoseStamped>(node, body, topics::kCmdPose);
  }
}

template <typename Message>
void CommandBridge::subscribe(ros::NodeHandle& node, int body, const char* leaf) {
  // The full callback: it tells who sent the message.
  using Event = const ros::MessageEvent<const Message>&;
  ros::SubscribeOptions options;
  options.initByFullCallbackType<Event>(
      topics::of_body(reader_.bodies()[body], leaf), kQueue,
      [this, body](Event event) { reader_.take(body, *event.getConstMessage(), event.getPublisherName()); });
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  subscribers_.push_back(node.subscribe(options));
}

void CommandBridge::find_strangers() {
  ros::master::V_TopicInfo topics_there;
  if (!ros::master::getTopics(topics_there)) return;
  for (const ros::master::TopicInfo& topic : topics_there) {
    if (topic.name.compare(0, prefix_.size(), prefix_) != 0) continue;
    const std::size_t slash = topic.name.rfind('/');
    const std::string leaf = topic.name.substr(slash + 1);
    if (leaf != topics::kCmdVel && leaf != topics::kCmdVelStamped && leaf != topics::kCmdPose &&
        leaf != topics::kCmdWrench && leaf != topics::kCmdWrenchStamped)
      continue;
    const std::string body = slash < prefix_.size() ? "" : topic.name.substr(prefix_.size(), slash - prefix_.size());
    if (reader_.find_body(body) >= 0 || !strangers_.insert(topic.name).second) continue;
    health_.refuse(fmt::format("commands on {}: there is no rigid body '{}'; {}", topic.name, body,
                               mpm::suggest(body, reader_.bodies())));
  }
}

}  // namespace mpm_ros
