// Writes a run's messages to a bag in this process, without a master: nothing is lost on the way.
//
// A long run can be split into parts (message/bag_parts.hpp). A part ends at a sync point only, and each begins with
// the latched messages, so that it can be replayed alone. What a process that was killed had recorded is on the disk up
// to the last whole chunk; a chunk ends after 768 kB, at the sync point after a chunk period of wall time, and at the
// run's start. rosbag keeps the bytes of a chunk in memory as well, and lets go of them only when a message makes the
// chunk too large: so the message after a cut is a chunk of its own.
//
// Weak: rosbag holds an entry for each chunk of a part in memory until the part is closed; splitting keeps that
// bounded.
#pragma once

#include <rosbag/bag.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "mpm_ros/message/bag_error.hpp"
#include "mpm_ros/message/message_sink.hpp"
#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {

struct BagOptions {
  std::string topics_below = "/mpm";  ///< namespace of the topics in the bag; "/" for none
  std::string compression = "none";   ///< compression of chunks: "none", "lz4" or "bz2"
  std::uint64_t split_size = 0;       ///< [byte] at which a part ends; 0: never
  std::int64_t split_duration = 0;    ///< [ns] simulated, the same
  bool required = true;               ///< false: a disk that fails ends the record, not the run; see failure()
  /// Wall time after which a chunk ends at the next sync point.
  std::chrono::steady_clock::duration chunk_period = std::chrono::seconds(1);
};

class BagRecorder : public MessageSink {
 public:
  /// Replaces a recording of that name, all its parts. @throws BagError
  explicit BagRecorder(const std::string& path, const BagOptions& options = {});
  /// Closes the bag, so that it can be read whatever ended the run.
  ~BagRecorder() override;

  /// Path of the first part.
  const std::string& path() const { return path_; }
  /// Parts written so far, the present one among them.
  int parts() const { return part_; }
  /// True if files of an earlier recording were replaced.
  bool replaced() const { return replaced_; }
  /// Reason why the record ended before the run, one line; empty while it goes on.
  const std::string& failure() const { return failure_; }

  /// Everything of a sync point is written: a part, or a chunk, may end here. @throws BagError
  void sync_point();
  /// @throws BagError when the end of the file cannot be written.
  void close();

  /// All but what another topic has in another form.
  bool wants(const std::string& topic) const override { return bag_ != nullptr && topic != topics::kTerrainImage; }
  // Each @throws BagError when it cannot be written and the record is required; once, then nothing more is written.
  void put(const std::string& topic, const ros::Time& stamp, const RunInfo& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const visualization_msgs::MarkerArray& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const ContactForces& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const geometry_msgs::WrenchStamped& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const BodyStates& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const SolverState& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const GlobalQuantities& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const Cracks& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const sensor_msgs::JointState& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const RobotStates& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const JointCommand& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const StateSet& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const tf2_msgs::TFMessage& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const sensor_msgs::PointCloud2& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const Command& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const HeightMap& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const Volumes& message) override;

 private:
  void open();
  /// The name must still be that of the file which is written. @throws BagError as on_disk()
  void check_there();
  /// Ends the present part, and begins the next with the latched messages.
  void begin_part(const ros::Time& stamp);
  template <typename Message>
  void write(const std::string& topic, const ros::Time& stamp, const Message& message);
  template <typename Message>
  void write_latched(const std::string& topic, const ros::Time& stamp, const Message& message);
  /// `name`: of the topic in the bag.
  template <typename Message>
  void to_bag(const std::string& name, const ros::Time& stamp, const Message& message,
              const boost::shared_ptr<ros::M_string>& header = {});
  /// Does what may fail for want of a disk.
  template <typename Work>
  void on_disk(const Work& work);
  void give_up(const std::string& reason);
  /// The topic's name in the bag.
  std::string resolve(const std::string& topic) const;

  std::string path_;
  const BagOptions options_;
  std::string prefix_;
  std::unique_ptr<rosbag::Bag> bag_;                ///< bag of the present part; null when closed or given up
  std::pair<std::uint64_t, std::uint64_t> opened_;  ///< device and number of its file
  int part_ = 1;
  bool part_over_ = false;
  bool started_ = false;  ///< the chunk of the run's start has ended
  bool cut_ = false;      ///< a chunk was cut, and rosbag still holds its bytes
  bool replaced_ = false;
  std::string failure_;
  std::optional<RunInfo> info_;
  std::optional<visualization_msgs::MarkerArray> markers_;
  std::optional<tf2_msgs::TFMessage> frames_;
  ros::Time last_;         ///< stamp written last
  std::uint64_t end_ = 0;  ///< [ns] stamp at which the present part ends by its duration; 0: nothing is written yet
  std::chrono::steady_clock::time_point chunk_began_;
};

}  // namespace mpm_ros
