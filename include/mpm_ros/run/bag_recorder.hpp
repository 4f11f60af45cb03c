// Writes a run's messages to a bag in this process, without a master: nothing is lost on the way.
#pragma once

#include <rosbag/bag.h>

#include <string>

#include "mpm_ros/message/bag_error.hpp"
#include "mpm_ros/message/message_sink.hpp"

namespace mpm_ros {

struct BagOptions {
  std::string topics_below = "/mpm";  ///< namespace of the topics in the bag; "/" for none
  std::string compression = "none";   ///< of chunks: "none", "lz4" or "bz2"
};

class BagRecorder : public MessageSink {
 public:
  /// Overwrites a file of that name. @throws BagError
  explicit BagRecorder(const std::string& path, const BagOptions& options = {});
  /// Closes the bag, so that it can be read whatever ended the run.
  ~BagRecorder() override;

  const std::string& path() const { return path_; }
  /// @throws BagError when the end of the file cannot be written.
  void close();

  bool wants(const std::string&) const override { return true; }
  // Each @throws BagError when it cannot be written.
  void put(const std::string& topic, const ros::Time& stamp, const RunInfo& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const visualization_msgs::MarkerArray& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const ContactForces& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const geometry_msgs::WrenchStamped& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const BodyStates& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const SolverState& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const GlobalQuantities& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const tf2_msgs::TFMessage& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const sensor_msgs::PointCloud2& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const Command& message) override;

 private:
  template <typename Message>
  void write(const std::string& topic, const ros::Time& stamp, const Message& message);
  /// The topic's name in the bag.
  std::string resolve(const std::string& topic) const;

  std::string path_;
  std::string prefix_;
  rosbag::Bag bag_;
};

/// `path` as given; "auto" stands for ./mpm_<scene>_<date and time>.bag. `run` > 1 (after resets) is added before the
/// ending: a bag holds one run.
std::string bag_path(const std::string& path, const std::string& scene, int run);

}  // namespace mpm_ros
