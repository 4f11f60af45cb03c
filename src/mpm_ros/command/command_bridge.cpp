#include "mpm_ros/command/command_bridge.hpp"

#include <fmt/format.h>
#include <ros/master.h>
#include <tf2/exceptions.h>

#include <algorithm>

#include "mpm/scene/nearest.hpp"
#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {

namespace {

constexpr std::uint32_t kQueue = 1000;
constexpr std::size_t kLongestFrame = 255;
/// A stamp farther ahead of the simulation than this [ns] comes from another clock: nobody plans an hour ahead.
constexpr std::int64_t kFarthest = 3'600'000'000'000;

}  // namespace

CommandBridge::CommandBridge(ros::NodeHandle node, const std::vector<std::string>& bodies,
                             const std::string& world_frame, CommandQueue& queue, NodeHealth& health)
    : bodies_(bodies),
      world_frame_(world_frame),
      prefix_(node.resolveName(topics::kBodies) + "/"),
      queue_(queue),
      health_(health),
      listener_(frames_) {
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  for (int body = 0; body < static_cast<int>(bodies_.size()); ++body) {
    const auto topic = [&](const char* leaf) { return topics::of_body(bodies_[body], leaf); };
    subscribers_.push_back(node.subscribe<geometry_msgs::Twist>(
        topic(topics::kCmdVel), kQueue,
        [this, body](const geometry_msgs::TwistConstPtr& message) { on_twist(body, *message); }, {}, hints));
    subscribers_.push_back(node.subscribe<geometry_msgs::TwistStamped>(
        topic(topics::kCmdVelStamped), kQueue,
        [this, body](const geometry_msgs::TwistStampedConstPtr& message) { on_twist_stamped(body, *message); }, {},
        hints));
    subscribers_.push_back(node.subscribe<geometry_msgs::PoseStamped>(
        topic(topics::kCmdPose), kQueue,
        [this, body](const geometry_msgs::PoseStampedConstPtr& message) { on_pose(body, *message); }, {}, hints));
  }
}

void CommandBridge::set_stamps(const Stamps& stamps) {
  const std::lock_guard<std::mutex> lock(mutex_);
  stamps_ = stamps;
}

int CommandBridge::find_body(const std::string& name) const {
  const auto body = std::find(bodies_.begin(), bodies_.end(), name);
  return body == bodies_.end() ? -1 : static_cast<int>(body - bodies_.begin());
}

mpm::Pose CommandBridge::find_frame(const std::string& frame, const ros::Time& stamp, int& body,
                                    std::string& problem) const {
  body = -1;
  if (frame.size() > kLongestFrame) {
    problem = fmt::format("the frame's name has {} characters; the most is {}", frame.size(), kLongestFrame);
    return {};
  }
  if (frame.empty() || frame == world_frame_) return {};
  // The simulation knows its own bodies better than tf does, which hears of them a message later.
  body = find_body(frame);
  if (body >= 0) return {};
  try {
    geometry_msgs::TransformStamped transform;
    try {
      transform = frames_.lookupTransform(world_frame_, frame, stamp);
    } catch (const tf2::ExtrapolationException&) {
      transform = frames_.lookupTransform(world_frame_, frame, ros::Time());
    }
    geometry_msgs::Pose pose;
    pose.position.x = transform.transform.translation.x;
    pose.position.y = transform.transform.translation.y;
    pose.position.z = transform.transform.translation.z;
    pose.orientation = transform.transform.rotation;
    problem = problem_of(pose);
    if (problem.empty()) return checked_pose(pose);
    problem = fmt::format("the transform from {} to {}: {}", world_frame_, frame, problem);
  } catch (const tf2::TransformException& error) {
    problem = fmt::format("frame '{}' is not known to tf ({})", frame, error.what());
  }
  return {};
}

void CommandBridge::set_stamp(const ros::Time& stamp, BodyCommand& command, std::string& problem) const {
  command.requested = stamp;
  if (stamp.isZero()) {
    command.late = true;
    return;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  command.stamp = std::max<std::int64_t>(stamps_.time_of(stamp), -1);
  if (*command.stamp - queue_.passed() > kFarthest) {
    problem = fmt::format("the stamp lies {:.0f} s ahead of the simulation; does the sender read the same clock?",
                          static_cast<double>(*command.stamp - queue_.passed()) * 1e-9);
  }
}

void CommandBridge::read_twist(const geometry_msgs::Twist& twist, const std::string& frame, const ros::Time& stamp,
                               BodyCommand& command, std::string& problem) const {
  command.kind = CommandKind::velocity;
  problem = problem_of(twist);
  if (!problem.empty()) return;
  const mpm::Pose axes = find_frame(frame, stamp, command.frame_body, problem);
  const mpm::Twist given = from_message(twist);
  // Left untouched where nothing is to be turned, so that the bits are those of the message.
  command.twist = axes.orientation.coeffs() == mpm::Quat::Identity().coeffs()
                      ? given
                      : mpm::Twist{axes.orientation * given.linear, axes.orientation * given.angular};
}

void CommandBridge::read_pose(const geometry_msgs::Pose& pose, const std::string& frame, const ros::Time& stamp,
                              BodyCommand& command, std::string& problem) const {
  command.kind = CommandKind::pose;
  problem = problem_of(pose);
  if (!problem.empty()) return;
  const mpm::Pose origin = find_frame(frame, stamp, command.frame_body, problem);
  const mpm::Pose given = checked_pose(pose);
  command.pose = {origin.to_world(given.position), (origin.orientation * given.orientation).normalized()};
}

void CommandBridge::push_or_refuse(const std::string& topic, BodyCommand command, const std::string& problem) {
  if (problem.empty()) {
    queue_.push(std::move(command));
  } else {
    health_.refuse(fmt::format("a command on {}{}: {}", prefix_, topic, problem));
  }
}

void CommandBridge::on_twist(int body, const geometry_msgs::Twist& message) {
  BodyCommand command;
  command.body = body;
  std::string problem;
  read_twist(message, world_frame_, ros::Time(), command, problem);
  push_or_refuse(bodies_[body] + "/" + topics::kCmdVel, std::move(command), problem);
}

void CommandBridge::on_twist_stamped(int body, const geometry_msgs::TwistStamped& message) {
  BodyCommand command;
  command.body = body;
  std::string problem;
  set_stamp(message.header.stamp, command, problem);
  if (problem.empty()) read_twist(message.twist, message.header.frame_id, message.header.stamp, command, problem);
  push_or_refuse(bodies_[body] + "/" + topics::kCmdVelStamped, std::move(command), problem);
}

void CommandBridge::on_pose(int body, const geometry_msgs::PoseStamped& message) {
  BodyCommand command;
  command.body = body;
  std::string problem;
  set_stamp(message.header.stamp, command, problem);
  if (problem.empty()) read_pose(message.pose, message.header.frame_id, message.header.stamp, command, problem);
  push_or_refuse(bodies_[body] + "/" + topics::kCmdPose, std::move(command), problem);
}

BodyCommand CommandBridge::read(const mpm_ros::Command& message, std::string& problem) const {
  BodyCommand command;
  command.body = find_body(message.body);
  if (command.body < 0) {
    problem = fmt::format("there is no rigid body '{}'; {}", message.body, mpm::suggest(message.body, bodies_));
    return command;
  }
  const std::string& frame = message.header.frame_id;
  if (message.kind == mpm_ros::Command::VELOCITY) {
    read_twist(message.twist, frame, ros::Time(), command, problem);
  } else if (message.kind == mpm_ros::Command::POSE) {
    read_pose(message.pose, frame, ros::Time(), command, problem);
    if (!message.arrival.isZero()) {
      const std::lock_guard<std::mutex> lock(mutex_);
      command.stamp = stamps_.time_of(message.arrival);
    }
  } else {
    problem = fmt::format("kind is {}; it must be VELOCITY ({}) or POSE ({})", message.kind,
                          +mpm_ros::Command::VELOCITY, +mpm_ros::Command::POSE);
  }
  command.requested = message.requested;
  if (!problem.empty()) problem = fmt::format("the command for '{}': {}", message.body, problem);
  return command;
}

void CommandBridge::find_strangers() {
  ros::master::V_TopicInfo topics_there;
  if (!ros::master::getTopics(topics_there)) return;
  for (const ros::master::TopicInfo& topic : topics_there) {
    if (topic.name.compare(0, prefix_.size(), prefix_) != 0) continue;
    const std::size_t slash = topic.name.rfind('/');
    const std::string leaf = topic.name.substr(slash + 1);
    if (leaf != topics::kCmdVel && leaf != topics::kCmdVelStamped && leaf != topics::kCmdPose) continue;
    const std::string body = slash < prefix_.size() ? "" : topic.name.substr(prefix_.size(), slash - prefix_.size());
    if (find_body(body) >= 0 || !strangers_.insert(topic.name).second) continue;
    health_.refuse(
        fmt::format("commands on {}: there is no rigid body '{}'; {}", topic.name, body, mpm::suggest(body, bodies_)));
  }
}

AppliedCommand in_world(const DueCommand& due, const std::vector<mpm::BodyState>& bodies, std::int64_t effect) {
  AppliedCommand applied;
  applied.body = due.command.body;
  applied.kind = due.command.kind;
  applied.twist = due.command.twist;
  applied.pose = due.command.pose;
  applied.effect = effect;
  applied.arrival = due.arrival;
  applied.requested = due.command.requested;
  if (due.command.frame_body >= 0) {
    const mpm::Pose& frame = bodies[due.command.frame_body].pose;
    applied.twist = {frame.orientation * applied.twist.linear, frame.orientation * applied.twist.angular};
    applied.pose = {frame.to_world(applied.pose.position), (frame.orientation * applied.pose.orientation).normalized()};
  }
  return applied;
}

}  // namespace mpm_ros
