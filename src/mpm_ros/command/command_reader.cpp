#include "mpm_ros/command/command_reader.hpp"

#include <fmt/format.h>
#include <tf2/exceptions.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "mpm/math/nearest.hpp"
#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {

namespace {

constexpr std::size_t kLongestFrame = 255;
constexpr const char* kFollowing = "tf";  // stands for a topic where a frame's pose is refused

}  // namespace

CommandReader::CommandReader(std::vector<std::string> bodies, std::string world_frame, const std::string& prefix,
                             const tf2::BufferCore& frames, CommandQueue& queue, NodeHealth& health)
    : bodies_(std::move(bodies)),
      world_frame_(std::move(world_frame)),
      frames_(frames),
      queue_(queue),
      health_(health),
      followed_(bodies_.size()) {
  for (const std::string& body : bodies_) below_.push_back(prefix + body);
}

void CommandReader::set_stamps(const Stamps& stamps) {
  const std::lock_guard<std::mutex> taking(taking_);
  const std::lock_guard<std::mutex> lock(mutex_);
  stamps_ = stamps;
  newest_ = {};
}

int CommandReader::find_body(const std::string& name) const {
  const auto body = std::find(bodies_.begin(), bodies_.end(), name);
  return body == bodies_.end() ? -1 : static_cast<int>(body - bodies_.begin());
}

mpm::Pose CommandReader::find_frame(const std::string& frame, const ros::Time& stamp, int& body,
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
    const geometry_msgs::Pose pose = to_pose(transform.transform);
    problem = problem_of(pose);
    if (problem.empty()) return checked_pose(pose);
    problem = fmt::format("the transform from {} to {}: {}", world_frame_, frame, problem);
  } catch (const std::runtime_error& error) {  // tf2's, or times that a ros::Duration cannot hold
    problem = fmt::format("frame '{}' is not known to tf ({})", frame, error.what());
  }
  return {};
}

void CommandReader::set_stamp(const ros::Time& stamp, BodyCommand& command, std::string& problem) const {
  command.requested = stamp;
  if (stamp.isZero()) {
    command.late = true;
    return;
  }
  if (!use_stamps_) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  command.stamp = std::max<std::int64_t>(stamps_.time_of(stamp), -1);
  problem = too_far_ahead(*command.stamp);
  if (problem.empty() && *command.stamp > newest_.stamp) newest_ = {command.body, *command.stamp};
}

CommandReader::Newest CommandReader::newest() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return newest_;
}

std::string CommandReader::too_far_ahead(std::int64_t stamp) const {
  const std::int64_t ahead = stamp - queue_.passed();
  if (ahead <= CommandQueue::kHorizon) return {};
  return fmt::format(
      "the stamp lies {:.0f} s ahead of the simulation, and at most {:.0f} s are taken; does the sender read the same "
      "clock?",
      mpm::seconds_of(ahead), mpm::seconds_of(CommandQueue::kHorizon));
}

void CommandReader::read_twist(const geometry_msgs::Twist& twist, const std::string& frame, const ros::Time& stamp,
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

void CommandReader::read_wrench(const geometry_msgs::Wrench& wrench, const std::string& frame, const ros::Time& stamp,
                                BodyCommand& command, std::string& problem) const {
  command.kind = CommandKind::wrench;
  const mpm::Wrench given = from_message(wrench);
  if (!given.force.allFinite() || !given.torque.allFinite()) {
    problem = "a component of the wrench is not finite";
    return;
  }
  // The axes alone are the frame's: the torque stays about the body's origin.
  const mpm::Pose axes = find_frame(frame, stamp, command.frame_body, problem);
  command.wrench = {axes.orientation * given.force, axes.orientation * given.torque};
}

void CommandReader::read_pose(const geometry_msgs::Pose& pose, const std::string& frame, const ros::Time& stamp,
                              BodyCommand& command, std::string& problem) const {
  command.kind = CommandKind::pose;
  problem = problem_of(pose);
  if (!problem.empty()) return;
  const mpm::Pose origin = find_frame(frame, stamp, command.frame_body, problem);
  const mpm::Pose given = checked_pose(pose);
  command.pose = {origin.to_world(given.position), (origin.orientation * given.orientation).normalized()};
}

void CommandReader::push_or_refuse(const char* leaf, BodyCommand command, const std::string& problem) {
  const int body = command.body;
  std::string refused = problem;
  if (refused.empty()) {
    const bool taken = leaf == kFollowing ? queue_.push_past_hold(std::move(command)) : queue_.push(std::move(command));
    if (!taken) {
      refused = fmt::format(
          "{} commands wait for their time already, which is the most for a body; send them when they are due",
          CommandQueue::kMost);
    }
  }
  if (!refused.empty()) {
    health_.refuse(fmt::format("a command on {}/{}: {}", below_[body], leaf, refused));
  }
  if (leaf == kFollowing) return;  // looked up here, not received
  count_message();
}

void CommandReader::count_message() {
  {
    const std::lock_guard<std::mutex> lock(received_mutex_);
    ++received_;
  }
  received_changed_.notify_all();
}

std::string CommandReader::refusal_of(int body) const {
  if (followed_[body].empty()) return {};
  return fmt::format("it follows the tf frame '{}' (drive: tf), and takes no other commands", followed_[body]);
}

std::uint64_t CommandReader::received() const {
  const std::lock_guard<std::mutex> lock(received_mutex_);
  return received_;
}

std::uint64_t CommandReader::missing() const { return missing_; }

// A sender that starts again counts from zero again.
void CommandReader::count_missing(int body, const char* leaf, const std::string& sender,
                                  const std_msgs::Header& header) {
  const auto [last, fresh] = last_seq_.try_emplace({body, leaf, sender}, header.seq);
  if (!fresh && header.seq > last->second) missing_ += header.seq - last->second - 1;
  last->second = header.seq;
}

bool CommandReader::wait_received(std::uint64_t count, std::chrono::milliseconds patience) const {
  std::unique_lock<std::mutex> lock(received_mutex_);
  return received_changed_.wait_for(lock, patience, [&] { return received_ >= count; });
}

void CommandReader::take_unstamped(const char* leaf, BodyCommand command, const geometry_msgs::Twist& message) {
  const std::lock_guard<std::mutex> taking(taking_);
  const int axes = command.frame_body;
  std::string problem = refusal_of(command.body);
  if (problem.empty()) read_twist(message, world_frame_, ros::Time(), command, problem);
  command.frame_body = axes;
  push_or_refuse(leaf, std::move(command), problem);
}

void CommandReader::take(int body, const geometry_msgs::Twist& message, const std::string& sender) {
  BodyCommand command;
  command.body = body;
  command.sender = sender;
  take_unstamped(topics::kCmdVel, std::move(command), message);
}

void CommandReader::take(int body, const geometry_msgs::TwistStamped& message, const std::string& sender) {
  const std::lock_guard<std::mutex> taking(taking_);
  count_missing(body, topics::kCmdVelStamped, sender, message.header);
  BodyCommand command;
  command.body = body;
  command.sender = sender;
  std::string problem = refusal_of(body);
  if (problem.empty()) set_stamp(message.header.stamp, command, problem);
  if (problem.empty()) read_twist(message.twist, message.header.frame_id, message.header.stamp, command, problem);
  push_or_refuse(topics::kCmdVelStamped, std::move(command), problem);
}

void CommandReader::take_own(int body, const geometry_msgs::Twist& message, const std::string& sender) {
  BodyCommand command;
  command.body = command.frame_body = body;
  command.sender = sender;
  take_unstamped(topics::kCmdVelBody, std::move(command), message);
}

void CommandReader::take(int body, const geometry_msgs::Wrench& message, const std::string& sender) {
  const std::lock_guard<std::mutex> taking(taking_);
  BodyCommand command;
  command.body = body;
  command.sender = sender;
  std::string problem;
  read_wrench(message, world_frame_, ros::Time(), command, problem);
  push_or_refuse(topics::kCmdWrench, std::move(command), problem);
}

void CommandReader::take(int body, const geometry_msgs::WrenchStamped& message, const std::string& sender) {
  const std::lock_guard<std::mutex> taking(taking_);
  count_missing(body, topics::kCmdWrenchStamped, sender, message.header);
  BodyCommand command;
  command.body = body;
  command.sender = sender;
  std::string problem;
  set_stamp(message.header.stamp, command, problem);
  if (problem.empty()) read_wrench(message.wrench, message.header.frame_id, message.header.stamp, command, problem);
  push_or_refuse(topics::kCmdWrenchStamped, std::move(command), problem);
}

void CommandReader::take(int body, const geometry_msgs::PoseStamped& message, const std::string& sender) {
  const std::lock_guard<std::mutex> taking(taking_);
  count_missing(body, topics::kCmdPose, sender, message.header);
  BodyCommand command;
  command.body = body;
  command.sender = sender;
  std::string problem = refusal_of(body);
  if (problem.empty()) set_stamp(message.header.stamp, command, problem);
  if (problem.empty()) read_pose(message.pose, message.header.frame_id, message.header.stamp, command, problem);
  push_or_refuse(topics::kCmdPose, std::move(command), problem);
}

void CommandReader::follow(int body, const geometry_msgs::PoseStamped& message, bool by_stamp) {
  const std::lock_guard<std::mutex> taking(taking_);
  BodyCommand command;
  command.body = body;
  command.requested = message.header.stamp;
  std::string problem;
  if (by_stamp) set_stamp(message.header.stamp, command, problem);
  if (problem.empty()) read_pose(message.pose, message.header.frame_id, message.header.stamp, command, problem);
  push_or_refuse(kFollowing, std::move(command), problem);
}

BodyCommand CommandReader::read(const mpm_ros::Command& message, std::string& problem) const {
  BodyCommand command;
  command.body = find_body(message.body);
  if (command.body < 0) {
    problem = fmt::format("there is no rigid body '{}'; {}", message.body, mpm::suggest(message.body, bodies_));
    return command;
  }
  const std::string& frame = message.header.frame_id;
  problem = refusal_of(command.body);
  if (!problem.empty()) {
    problem = fmt::format("the command for '{}': {}", message.body, problem);
    return command;
  }
  if (message.kind == mpm_ros::Command::VELOCITY) {
    read_twist(message.twist, frame, ros::Time(), command, problem);
  } else if (message.kind == mpm_ros::Command::POSE) {
    read_pose(message.pose, frame, ros::Time(), command, problem);
    if (!message.arrival.isZero()) {
      const std::lock_guard<std::mutex> lock(mutex_);
      command.stamp = stamps_.time_of(message.arrival);
      if (problem.empty()) problem = too_far_ahead(*command.stamp);
    }
  } else if (message.kind == mpm_ros::Command::WRENCH) {
    read_wrench(message.wrench, frame, ros::Time(), command, problem);
  } else {
    problem = fmt::format("kind is {}; it must be VELOCITY ({}), POSE ({}) or WRENCH ({})", message.kind,
                          +mpm_ros::Command::VELOCITY, +mpm_ros::Command::POSE, +mpm_ros::Command::WRENCH);
  }
  command.requested = message.requested;
  if (!problem.empty()) problem = fmt::format("the command for '{}': {}", message.body, problem);
  return command;
}

AppliedCommand in_world(const DueCommand& due, const std::vector<mpm::BodyState>& bodies, std::int64_t effect) {
  AppliedCommand applied;
  applied.body = due.command.body;
  applied.kind = due.command.kind;
  applied.twist = due.command.twist;
  applied.stamp_ignored = !due.command.requested.isZero() && !due.command.stamp;
  applied.wrench = due.command.wrench;
  applied.pose = due.command.pose;
  applied.effect = effect;
  applied.arrival = due.arrival;
  applied.requested = due.command.requested;
  if (due.command.frame_body >= 0) {
    const mpm::Pose& frame = bodies[due.command.frame_body].pose;
    if (applied.kind == CommandKind::velocity && due.command.frame_body == applied.body) applied.own = applied.twist;
    applied.twist = {frame.orientation * applied.twist.linear, frame.orientation * applied.twist.angular};
    applied.wrench = {frame.orientation * applied.wrench.force, frame.orientation * applied.wrench.torque};
    applied.pose = {frame.to_world(applied.pose.position), (frame.orientation * applied.pose.orientation).normalized()};
  }
  return applied;
}

}  // namespace mpm_ros
