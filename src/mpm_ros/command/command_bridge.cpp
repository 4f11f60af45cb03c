#include "mpm_ros/command/command_bridge.hpp"

#include <fmt/format.h>
#include <ros/master.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <algorithm>
#include <stdexcept>

#include "mpm/math/nearest.hpp"
#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {

namespace {

/// Messages of a topic that wait for the thread that takes them: three seconds of 3,000 a second.
constexpr std::uint32_t kQueue = 10'000;
constexpr const char* kBase = "/base";  ///< between a robot's name and the last one of a topic

}  // namespace

CommandBridge::CommandBridge(ros::NodeHandle node, const std::vector<std::string>& bodies, std::size_t bases,
                             const std::vector<std::string>& frames, const std::string& world_frame,
                             CommandQueue& queue, NodeHealth& health, bool latest_frames, bool latest_commands)
    : prefix_(node.resolveName(topics::kBodies) + "/"),
      robots_prefix_(node.resolveName(topics::kRobots) + "/"),
      health_(health),
      reader_(bodies, world_frame, prefix_, frames_, queue, health),
      follower_(frames, world_frame, frames_, reader_, health, latest_frames),
      dropped_commands_([this](const std::string& topic) { return commanded_on(topic); }),
      dropped_transforms_([tf = node.resolveName(topics::kTf)](const std::string& topic) { return topic == tf; }) {
  if (latest_commands) reader_.ignore_stamps();
  const auto first_base = static_cast<int>(bodies.size() - bases);
  own_frames_.insert(bodies.begin(), bodies.begin() + first_base);
  for (const std::string& frame : frames) own_frames_.erase(frame);
  listen(node, topics::kTf, false);
  listen(node, topics::kTfStatic, true);
  for (int body = 0; body < static_cast<int>(bodies.size()); ++body) {
    reader_.set_frame(body, frames[static_cast<std::size_t>(body)]);
    const std::string& name = bodies[static_cast<std::size_t>(body)];
    if (topics::is_link(name)) continue;  // its joints move it
    const bool base = body >= first_base;
    if (base) reader_.set_below(body, robots_prefix_ + name + kBase);
    subscribe<geometry_msgs::Twist>(node, body, topics::kCmdVel);
    subscribe<geometry_msgs::TwistStamped>(node, body, topics::kCmdVelStamped);
    subscribe<geometry_msgs::Twist>(node, body, topics::kCmdVelBody,
                                    [this](int to, const geometry_msgs::Twist& message, const std::string& sender) {
                                      reader_.take_own(to, message, sender);
                                    });
    subscribe<geometry_msgs::PoseStamped>(node, body, topics::kCmdPose);
    if (base) continue;  // no force moves it
    subscribe<geometry_msgs::Wrench>(node, body, topics::kCmdWrench);
    subscribe<geometry_msgs::WrenchStamped>(node, body, topics::kCmdWrenchStamped);
  }
}

template <typename Message>
void CommandBridge::subscribe(ros::NodeHandle& node, int body, const char* leaf) {
  subscribe<Message>(node, body, leaf, [this](int to, const Message& message, const std::string& sender) {
    reader_.take(to, message, sender);
  });
}

template <typename Message, typename Taking>
void CommandBridge::subscribe(ros::NodeHandle& node, int body, const char* leaf, Taking take) {
  // The full callback: it tells who sent the message.
  using Event = const ros::MessageEvent<const Message>&;
  ros::SubscribeOptions options;
  options.initByFullCallbackType<Event>(reader_.topic(body, leaf), kQueue, [body, take](Event event) {
    take(body, *event.getConstMessage(), event.getPublisherName());
  });
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  subscribers_.push_back(node.subscribe(options));
}

bool CommandBridge::commanded_on(const std::string& topic) const { return whom(topic).has_value(); }

std::optional<std::string> CommandBridge::whom(const std::string& topic) const {
  const std::size_t slash = topic.rfind('/');
  const auto& leaves = topics::kCommandLeaves;
  if (std::find(leaves.begin(), leaves.end(), topic.substr(slash + 1)) == leaves.end()) return std::nullopt;
  const auto between = [&](const std::string& prefix, std::size_t end) {
    return end < prefix.size() ? std::string() : topic.substr(prefix.size(), end - prefix.size());
  };
  if (topic.compare(0, prefix_.size(), prefix_) == 0) return between(prefix_, slash);
  const std::size_t length = std::char_traits<char>::length(kBase);
  if (topic.compare(0, robots_prefix_.size(), robots_prefix_) != 0 || slash < length ||
      topic.compare(slash - length, length, kBase) != 0) {
    return std::nullopt;
  }
  return between(robots_prefix_, slash - length);
}

void CommandBridge::find_dropped() {
  dropped_commands_.look();
  dropped_transforms_.look();
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
    if (own_frames_.count(transform.child_frame_id) > 0 && sender != ros::this_node::getName())
      health_.share_frame(transform.child_frame_id, sender);
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
    const std::optional<std::string> name = whom(topic);
    if (!name) continue;
    const int body = reader_.find_body(*name);
    if (body >= 0 && reader_.topic(body, topic.substr(topic.rfind('/') + 1)) == topic) continue;
    if (!strangers_.insert(topic).second) continue;
    const bool of_base = topic.compare(0, prefix_.size(), prefix_) != 0;
    health_.refuse(fmt::format("commands on {}: there is no {} '{}'; {}", topic,
                               of_base ? "robot with a base of kind moving called" : "rigid body", *name,
                               mpm::suggest(*name, reader_.bodies())));
  }
}

}  // namespace mpm_ros
