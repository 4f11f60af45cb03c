#include "mpm_ros/command/command_bridge.hpp"

#include <fmt/format.h>
#include <ros/master.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <stdexcept>

#include "mpm/math/nearest.hpp"
#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {

namespace {

constexpr std::uint32_t kQueue = 1000;

}  // namespace

CommandBridge::CommandBridge(ros::NodeHandle node, const std::vector<std::string>& bodies,
                             const std::vector<std::string>& frames, const std::string& world_frame,
                             CommandQueue& queue, NodeHealth& health, bool latest_frames, bool latest_commands)
    : prefix_(node.resolveName(topics::kBodies) + "/"),
      health_(health),
      reader_(bodies, world_frame, prefix_, frames_, queue, health),
      follower_(frames, world_frame, frames_, reader_, health, latest_frames) {
  if (latest_commands) reader_.ignore_stamps();
  listen(node, "/tf", false);
  listen(node, "/tf_static", true);
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

void CommandBridge::listen(ros::NodeHandle& node, const char* topic, bool fixed) {
  using Event = const ros::MessageEvent<const tf2_msgs::TFMessage>&;
  ros::SubscribeOptions options;
  options.initByFullCallbackType<Event>(
      topic, kQueue, [this, fixed](Event event) { hear(*event.getConstMessage(), event.getPublisherName(), fixed); });
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  subscribers_.push_back(node.subscribe(options));
}

void CommandBridge::hear(const tf2_msgs::TFMessage& message, const std::string& sender, bool fixed) {
  // A clock that was set back: moving frames are of another run.
  const ros::Time now = ros::Time::now();
  if (now < heard_) frames_.clear();
  heard_ = now;
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    try {
      frames_.setTransform(transform, sender, fixed);
    } catch (const std::runtime_error& error) {
      health_.refuse(fmt::format("a transform to '{}': {}", transform.child_frame_id, error.what()));
    }
  }
}

void CommandBridge::find_strangers() {
  // ros::master::getTopics() would wait for a master that is gone until the node ends.
  XmlRpc::XmlRpcValue request, response, published;
  request[0] = ros::this_node::getName();
  request[1] = "";
  if (!ros::master::execute("getPublishedTopics", request, response, published, false)) return;
  for (int i = 0; i < published.size(); ++i) {
    const std::string topic = published[i][0];
    if (topic.compare(0, prefix_.size(), prefix_) != 0) continue;
    const std::size_t slash = topic.rfind('/');
    const std::string leaf = topic.substr(slash + 1);
    if (leaf != topics::kCmdVel && leaf != topics::kCmdVelStamped && leaf != topics::kCmdPose &&
        leaf != topics::kCmdWrench && leaf != topics::kCmdWrenchStamped)
      continue;
    const std::string body = slash < prefix_.size() ? "" : topic.substr(prefix_.size(), slash - prefix_.size());
    if (reader_.find_body(body) >= 0 || !strangers_.insert(topic).second) continue;
    health_.refuse(fmt::format("commands on {}: there is no rigid body '{}'; {}", topic, body,
                               mpm::suggest(body, reader_.bodies())));
  }
}

}  // namespace mpm_ros
