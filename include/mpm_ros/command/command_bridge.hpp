// Hears the command topics of every rigid body, and tf for their frames, and hands the messages to a CommandReader.
//
// tf is heard here and not by tf2_ros::TransformListener, which ends the process when /clock jumps back by more than
// the 68 years that a ros::Duration holds.
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <set>
#include <string>
#include <vector>

#include "mpm_ros/command/command_reader.hpp"
#include "mpm_ros/command/dropped_messages.hpp"
#include "mpm_ros/command/frame_follower.hpp"

namespace mpm_ros {

class CommandBridge {
 public:
  /// Subscribes at once, on the node handle's callback queue. `bodies`: names, of which the last `bases` are robots
  /// whose base moves. `frames`: the tf frame that each follows, or empty.
  /// `queue` and `health` must outlive it.
  /// `latest_frames`, `latest_commands`: stamps of transforms, and of messages on topics, are not used.
  CommandBridge(ros::NodeHandle node, const std::vector<std::string>& bodies, std::size_t bases,
                const std::vector<std::string>& frames, const std::string& world_frame, CommandQueue& queue,
                NodeHealth& health, bool latest_frames, bool latest_commands);

  CommandReader& reader() { return reader_; }
  const CommandReader& reader() const { return reader_; }
  FrameFollower& follower() { return follower_; }

  /// The clock was set back: what tf knows of moving frames is of another run. Static frames stay.
  void forget_frames() { frames_.clear(); }

  /// Asks the master for command topics of bodies that the scene does not have, and refuses each once.
  void find_strangers();
  /// Asks roscpp what it has dropped: for the two below.
  void find_dropped();
  /// Commands, and messages of tf, that came faster than they were taken, and had no effect.
  std::uint64_t dropped_commands() const { return dropped_commands_.count(); }
  std::uint64_t dropped_transforms() const { return dropped_transforms_.count(); }

 private:
  template <typename Message>
  void subscribe(ros::NodeHandle& node, int body, const char* leaf);
  /// `take`: gets (body, message, sender).
  template <typename Message, typename Taking>
  void subscribe(ros::NodeHandle& node, int body, const char* leaf, Taking take);
  /// True if commands are heard on the topic.
  bool commanded_on(const std::string& topic) const;
  /// Name of the body, or of the robot whose base is meant, that such a topic is for.
  std::optional<std::string> whom(const std::string& topic) const;
  void listen(ros::NodeHandle& node, const char* topic, bool fixed);
  void hear(const tf2_msgs::TFMessage& message, const std::string& sender, bool fixed);

  const std::string prefix_, robots_prefix_;  // prefixes of topics of bodies and of robots, resolved
  NodeHealth& health_;
  tf2::BufferCore frames_;
  ros::Time heard_;  // by the clock, when a transform came last
  CommandReader reader_;
  FrameFollower follower_;
  std::vector<ros::Subscriber> subscribers_;
  std::set<std::string> own_frames_;  // that the node publishes
  std::set<std::string> strangers_;
  DroppedMessages dropped_commands_, dropped_transforms_;
};

}  // namespace mpm_ros
