// Reading back a bag that the node or run_scene recorded: which of its topics make up a run, and its messages one
// after the other with the simulated time they stand for. Messages are handed on and dropped, so a bag of any size
// is read in the memory of its largest chunk.
#pragma once

#include <mpm_ros/BodyStates.h>
#include <mpm_ros/Command.h>
#include <mpm_ros/ContactForces.h>
#include <mpm_ros/RunInfo.h>
#include <mpm_ros/SolverState.h>
#include <rosbag/bag.h>
#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/MarkerArray.h>

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mpm_ros/message/bag_error.hpp"
#include "mpm_ros/message/stamps.hpp"

namespace mpm_ros {

/// Receives the messages of a run. `time` [ns] is simulated, since the start: the message's stamp less the run's start.
class RunVisitor {
 public:
  virtual ~RunVisitor() = default;
  virtual void contact_forces(std::int64_t time, const ContactForces& message) { unused(time, message); }
  virtual void bodies(std::int64_t time, const BodyStates& message) { unused(time, message); }
  virtual void solver_state(std::int64_t time, const SolverState& message) { unused(time, message); }
  virtual void command(std::int64_t time, const Command& message) { unused(time, message); }
  virtual void particles(std::int64_t time, const sensor_msgs::PointCloud2& message) { unused(time, message); }
  virtual void markers(const visualization_msgs::MarkerArray& message) { unused(0, message); }

 private:
  template <typename Message>
  static void unused(std::int64_t /*time*/, const Message& /*message*/) {}
};

class RunBag {
 public:
  /// Opens the bag and finds the run in it. `name_space` is needed only when the bag holds several runs.
  /// @throws BagError when the file is missing, not a bag, not indexed, empty, holds no run, or lacks a topic
  RunBag(const std::string& path, const std::string& name_space);

  const std::string& path() const { return path_; }
  /// The namespace that the topics share: "/mpm", or "" for the root.
  const std::string& name_space() const { return name_space_; }
  /// What made the run; nothing when it was not recorded.
  const std::optional<RunInfo>& info() const { return info_; }
  /// The topics that a complete bag has and this one has not.
  const std::vector<std::string>& missing() const { return missing_; }

  /// One pass over all messages in the order of their recording.
  /// @throws BagError
  void read(const std::vector<RunVisitor*>& visitors);
  /// The chosen particle snapshots, counted from 0 in the order of their recording. @throws BagError
  void read_snapshots(const std::set<std::size_t>& chosen, RunVisitor& visitor);

 private:
  void open();
  void find_run(const std::string& wanted);
  void find_start();
  std::string topic(const std::string& name) const { return name_space_ + "/" + name; }
  template <typename Message>
  void hand_on(const rosbag::MessageInstance& instance, const std::vector<RunVisitor*>& visitors,
               void (RunVisitor::*receive)(std::int64_t, const Message&)) const;

  std::string path_;
  std::string name_space_;
  rosbag::Bag bag_;
  std::map<std::string, std::string> types_;  ///< of the topics in the bag
  std::optional<RunInfo> info_;
  std::vector<std::string> missing_;
  Stamps stamps_;
};

}  // namespace mpm_ros
