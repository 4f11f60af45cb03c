// Reading back a bag that the node or run_scene recorded: which of its topics make up a run, and its messages one
// after the other with the simulated time they stand for. Messages are handed on and dropped, so a bag of any size
// is read in the memory of its largest chunk and of its index. A bag that was cut short is read from a copy with an
// index. Of a recording that was split, the first part stands for all.
#pragma once

#include <mpm_ros/BodyStates.h>
#include <mpm_ros/Command.h>
#include <mpm_ros/ContactForces.h>
#include <mpm_ros/Cracks.h>
#include <mpm_ros/GlobalQuantities.h>
#include <mpm_ros/HeightMap.h>
#include <mpm_ros/JointCommand.h>
#include <mpm_ros/RobotStates.h>
#include <mpm_ros/RunInfo.h>
#include <mpm_ros/SolverState.h>
#include <mpm_ros/StateSet.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/MarkerArray.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mpm/math/geometry.hpp"
#include "mpm_ros/message/bag_error.hpp"
#include "mpm_ros/message/stamps.hpp"
#include "mpm_ros/report/temporary_folder.hpp"

namespace mpm_ros {

/// True if a file begins as a bag does, whole or not.
bool is_bag(const std::string& path);

/// Receives the messages of a run. `time` [ns] is simulated, since the start: the message's stamp less the run's start.
class RunVisitor {
 public:
  virtual ~RunVisitor() = default;
  virtual void contact_forces(std::int64_t time, const ContactForces& message) { unused(time, message); }
  virtual void bodies(std::int64_t time, const BodyStates& message) { unused(time, message); }
  virtual void solver_state(std::int64_t time, const SolverState& message) { unused(time, message); }
  virtual void global_quantities(std::int64_t time, const GlobalQuantities& message) { unused(time, message); }
  virtual void cracks(std::int64_t time, const Cracks& message) { unused(time, message); }
  virtual void terrain(std::int64_t time, const HeightMap& message) { unused(time, message); }
  /// Lists of a robot are as long as that of its joints.
  virtual void robots(std::int64_t time, const RobotStates& message) { unused(time, message); }
  virtual void command(std::int64_t time, const Command& message) { unused(time, message); }
  virtual void joint_command(std::int64_t time, const JointCommand& message) { unused(time, message); }
  virtual void state_set(std::int64_t time, const StateSet& message) { unused(time, message); }
  /// A message on /clock, where that was recorded too.
  virtual void clock(std::int64_t time) { unused(time, 0); }
  /// Places are float64 in a scene that lies far from the origin.
  virtual void particles(std::int64_t time, const sensor_msgs::PointCloud2& message) { unused(time, message); }
  virtual void markers(const visualization_msgs::MarkerArray& message) { unused(0, message); }

 private:
  template <typename Message>
  static void unused(std::int64_t /*time*/, const Message& /*message*/) {}
};

/// Told from time to time which part of the messages, 0 to 1, is read.
using Reading = std::function<void(double part)>;

class RunBag {
 public:
  /// Opens the bag, and the parts after it, and finds the run in it. `name_space` is needed only when the bag holds
  /// several runs.
  /// @throws BagError when the file is missing, not a bag, empty, of another version, holds no run, or lacks a topic,
  /// or when a part is of another recording
  RunBag(const std::string& path, const std::string& name_space);

  const std::string& path() const { return path_; }
  /// Bags that are read: 1, or more of a recording that was split.
  std::size_t parts() const { return bags_.size(); }
  /// The namespace that the topics share: "/mpm", or "" for the root.
  const std::string& name_space() const { return name_space_; }
  /// Information on what made the run; nothing when it was not recorded.
  const std::optional<RunInfo>& info() const { return info_; }
  /// The topics that a complete bag has and this one has not.
  const std::vector<std::string>& missing() const { return missing_; }
  /// True if the recording was cut short, so that only a part of it could be read.
  bool cut_short() const { return copy_.has_value(); }
  const Stamps& stamps() const { return stamps_; }
  /// Gives the view the messages on these topics (full names), of all parts.
  void select(rosbag::View& view, const std::vector<std::string>& topics) const;
  /// Fields of the first particle snapshot, x, y, z and id among them; empty when there is none.
  const std::vector<std::string>& particle_fields() const { return particle_fields_; }

  /// One pass over all messages in the order of their recording.
  /// @throws BagError
  void read(const std::vector<RunVisitor*>& visitors, const Reading& reading = {});
  /// Only the solver states and the commands. @throws BagError
  void read_states_and_commands(RunVisitor& visitor);
  /// The chosen particle snapshots, counted from 0 in the order of their recording. @throws BagError
  void read_snapshots(const std::set<std::size_t>& chosen, RunVisitor& visitor, const Reading& reading = {});

 private:
  void open();
  /// False when nothing of it can be read, which only a part that follows others may be.
  bool open_part(const std::string& path, bool first);
  void open_copy(const std::string& path, rosbag::Bag& bag);
  void find_run(const std::string& wanted);
  void find_start();
  void check_parts() const;
  void find_fields();
  std::string topic(const std::string& name) const { return name_space_ + "/" + name; }
  template <typename Message>
  void hand_on(const rosbag::MessageInstance& instance, const std::vector<RunVisitor*>& visitors,
               void (RunVisitor::*receive)(std::int64_t, const Message&)) const;
  /// Clouds as they lie in the world.
  void hand_on_cloud(const rosbag::MessageInstance& instance, const std::vector<RunVisitor*>& visitors) const;
  void hand_on_robots(const rosbag::MessageInstance& instance, const std::vector<RunVisitor*>& visitors) const;
  void find_frames();

  std::string path_;
  std::string name_space_;
  std::optional<TemporaryFolder> copy_;             ///< holds the bags that are read in place of those cut short
  std::vector<std::unique_ptr<rosbag::Bag>> bags_;  ///< in the order of time
  std::map<std::string, std::string> types_;        ///< types of the topics in the bag
  std::optional<RunInfo> info_;
  std::vector<std::string> missing_;
  std::vector<std::string> particle_fields_;
  std::map<std::string, mpm::Vec3> origins_;  ///< origins of frames that are not the world's (local_frame.hpp)
  Stamps stamps_;
};

}  // namespace mpm_ros
