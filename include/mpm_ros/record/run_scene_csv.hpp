// The messages of a run written as CSV tables while it runs: the same tables that bag_report makes from a bag.
#pragma once

#include <map>
#include <string>

#include "mpm_ros/message/local_frame.hpp"
#include "mpm_ros/message/message_sink.hpp"
#include "mpm_ros/message/stamps.hpp"
#include "mpm_ros/report/report_csv.hpp"

namespace mpm_ros {

class CsvSink : public MessageSink {
 public:
  /// Makes the folder. @throws CsvError
  CsvSink(const std::string& folder, const Stamps& stamps, bool axisymmetric);
  /// Flushes all tables. @throws CsvError
  void close();

  bool wants(const std::string& topic) const override;
  // Each @throws CsvError when it cannot be written.
  void put(const std::string& topic, const ros::Time& stamp, const visualization_msgs::MarkerArray& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const ContactForces& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const BodyStates& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const SolverState& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const GlobalQuantities& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const Cracks& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const RobotStates& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const tf2_msgs::TFMessage& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const sensor_msgs::PointCloud2& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const Command& message) override;
  void put(const std::string& topic, const ros::Time& stamp, const HeightMap& message) override;

 private:
  Stamps stamps_;
  CsvExport tables_;
  SnapshotExport snapshots_;
  std::map<std::string, mpm::Vec3> origins_;  ///< origins of frames that are not the world's
};

}  // namespace mpm_ros
