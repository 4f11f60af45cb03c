// Hears the command topics of every rigid body, and tf for their frames, and hands the messages to a CommandReader.
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <set>
#include <string>
#include <vector>

#include "mpm_ros/command/command_reader.hpp"
#include "mpm_ros/command/frame_follower.hpp"

namespace mpm_ros {

class CommandBridge {
 public:
  /// Subscribes at once, on the node handle's callback queue. `frames`: the tf frame that each body follows, or empty.
  /// `queue` and `health` must outlive it.
  CommandBridge(ros::NodeHandle node, const std::vector<std::string>& bodies, const std::vector<std::string>& frames,
                const std::string& world_frame, CommandQueue& queue, NodeHealth& health);

  CommandReader& reader() { return reader_; }
  const CommandReader& reader() const { return reader_; }
  FrameFollower& follower() { return follower_; }

  /// The clock was set back: what tf knows of moving frames is of another run. Static frames stay.
  void forget_frames() { frames_.clear(); }

  /// Asks the master for command topics of bodies that the scene does not have, and refuses each once.
  void find_strangers();

 private:
  template <typename Message>
  void subscribe(ros::NodeHandle& node, int body, const char* leaf);

  const std::string prefix_;  // of body topics, resolved
  NodeHealth& health_;
  tf2_ros::Buffer frames_;
  tf2_ros::TransformListener listener_;
  CommandReader reader_;
  FrameFollower follower_;
  std::vector<ros::Subscriber> subscribers_;
  std::set<std::string> strangers_;
};

}  // namespace mpm_ros
