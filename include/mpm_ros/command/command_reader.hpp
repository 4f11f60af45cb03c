// From command messages to the queue: checks each message, turns its frame into the world's (or names the body in whose
// axes it stands), refuses what cannot be used with a reason and without any effect. Knows no ROS connection; it is
// CommandBridge that hears the topics.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <mpm_ros/Command.h>
#include <tf2/buffer_core.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <tuple>
#include <vector>

#include "mpm/definition/report.hpp"
#include "mpm_ros/command/command_queue.hpp"
#include "mpm_ros/message/node_health.hpp"
#include "mpm_ros/message/stamps.hpp"

namespace mpm_ros {

class CommandReader {
 public:
  /// `prefix`: of the bodies' topics, as refusals name them. What is given by reference must outlive it.
  CommandReader(std::vector<std::string> bodies, std::string world_frame, const std::string& prefix,
                const tf2::BufferCore& frames, CommandQueue& queue, NodeHealth& health);

  /// The run began (again): what stamps mean from now on. No message is being read by the old ones when it returns.
  void set_stamps(const Stamps& stamps);

  /// The body follows a tf frame: commands from elsewhere are refused, with the reason.
  void set_frame(int body, const std::string& frame) { followed_.at(body) = frame; }
  /// A body whose topics lie elsewhere than below its name.
  void set_below(int body, std::string below) { below_.at(body) = std::move(below); }
  /// The topic of its commands with this last name.
  std::string topic(int body, const std::string& leaf) const { return below_.at(body) + "/" + leaf; }
  /// Reads the place of that frame, as a message on cmd_pose; not `by_stamp`: as one without a stamp. Any thread.
  void follow(int body, const geometry_msgs::PoseStamped& message, bool by_stamp = true);
  /// Applies what comes on topics as it comes, whatever its stamp, which is recorded. Before any message is taken.
  void ignore_stamps() { use_stamps_ = false; }
  /// The command that was stamped latest since the run began, of those whose stamp was taken.
  struct Newest {
    int body = 0;
    std::int64_t stamp = 0;  ///< [ns] simulated
  };
  Newest newest() const;

  /// A message for a body (its index) from a node: to the queue, or refused. Any thread.
  void take(int body, const geometry_msgs::Twist& message, const std::string& sender = {});
  void take(int body, const geometry_msgs::TwistStamped& message, const std::string& sender = {});
  /// A twist in the body's own axes.
  void take_own(int body, const geometry_msgs::Twist& message, const std::string& sender = {});
  void take(int body, const geometry_msgs::Wrench& message, const std::string& sender = {});
  void take(int body, const geometry_msgs::WrenchStamped& message, const std::string& sender = {});
  void take(int body, const geometry_msgs::PoseStamped& message, const std::string& sender = {});
  /// Messages taken so far, those that were refused too.
  std::uint64_t received() const;
  /// Counts one that another reader has taken.
  void count_message();
  /// Messages with a header that were sent and did not come, by the gaps in the numbers that each sender gives them.
  std::uint64_t missing() const;
  /// Waits until so many have been taken, for `patience` of the wall's time at most. Any thread but those of take().
  bool wait_received(std::uint64_t count, std::chrono::milliseconds patience) const;
  /// A command of a step request, checked as those on topics are. `problem` says why not; then the result is of no use.
  BodyCommand read(const mpm_ros::Command& message, std::string& problem) const;

  /// Reason why the body takes no commands, or empty.
  std::string refusal_of(int body) const;
  const std::vector<std::string>& bodies() const { return bodies_; }
  /// -1 when there is none.
  int find_body(const std::string& name) const;

 private:
  /// A twist without a stamp, in the axes that the command names.
  void take_unstamped(const char* leaf, BodyCommand command, const geometry_msgs::Twist& message);
  void read_twist(const geometry_msgs::Twist& twist, const std::string& frame, const ros::Time& stamp,
                  BodyCommand& command, std::string& problem) const;
  void read_wrench(const geometry_msgs::Wrench& wrench, const std::string& frame, const ros::Time& stamp,
                   BodyCommand& command, std::string& problem) const;
  void read_pose(const geometry_msgs::Pose& pose, const std::string& frame, const ros::Time& stamp,
                 BodyCommand& command, std::string& problem) const;
  void set_stamp(const ros::Time& stamp, BodyCommand& command, std::string& problem) const;
  /// Reason why a simulated time [ns] cannot be meant, or empty.
  std::string too_far_ahead(std::int64_t stamp) const;
  void push_or_refuse(const char* leaf, BodyCommand command, const std::string& problem);
  void count_missing(int body, const char* leaf, const std::string& sender, const std_msgs::Header& header);
  /// Pose of a frame in the world, or the body whose frame it is.
  mpm::Pose find_frame(const std::string& frame, const ros::Time& stamp, int& body, std::string& problem) const;

  const std::vector<std::string> bodies_;
  const std::string world_frame_;
  std::vector<std::string> below_;  // namespace of each body's topics of commands
  const tf2::BufferCore& frames_;
  CommandQueue& queue_;
  NodeHealth& health_;
  std::vector<std::string> followed_;  // frame of each body, or empty
  std::mutex taking_;                  // a message, from its stamp to the queue
  bool use_stamps_ = true;
  mutable std::mutex mutex_;  // mutex of stamps_ and newest_
  Stamps stamps_;
  mutable Newest newest_;
  mutable std::mutex received_mutex_;
  mutable std::condition_variable received_changed_;
  std::uint64_t received_ = 0;
  std::map<std::tuple<int, std::string, std::string>, std::uint32_t> last_seq_;  // by body, topic and sender
  std::atomic<std::uint64_t> missing_{0};
};

/// A due command in world axes; `bodies` as they are at its effect [ns].
AppliedCommand in_world(const DueCommand& due, const std::vector<mpm::BodyState>& bodies, std::int64_t effect);

}  // namespace mpm_ros
