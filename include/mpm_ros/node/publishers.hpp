// The node's publishers. A message is worth making when somebody subscribes, or when it is latched for those to come.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <map>
#include <string>
#include <vector>

#include "mpm/robot/definition.hpp"
#include "mpm_ros/message/message_sink.hpp"

namespace mpm_ros {

class Publishers : public MessageSink {
 public:
  /// Advertises every topic, below the node's namespace. @param bodies names of the rigid bodies; `filtered`: their
  /// filtered wrenches too
  Publishers(ros::NodeHandle node, const std::vector<std::string>& bodies, bool filtered = false);
  /// Global quantities too, from now on.
  void add_global();
  /// The same of cracks.
  void add_cracks();
  /// The same of a robot's joints and sensors.
  void add_robot(const mpm::RobotDefinition& robot);
  /// The same of maps of the ground, latched.
  void add_ground();
  /// The same of the material in volumes.
  void add_volumes();
  /// The same of the frame of a scene far from the origin.
  void add_static_frames();

  bool wants(const std::string& topic) const override;
  void put(const std::string& topic, const ros::Time&, const RunInfo& m) override { at(topic).publish(m); }
  void put(const std::string& topic, const ros::Time&, const visualization_msgs::MarkerArray& m) override {
    at(topic).publish(m);
  }
  void put(const std::string& topic, const ros::Time&, const ContactForces& m) override { at(topic).publish(m); }
  void put(const std::string& topic, const ros::Time&, const geometry_msgs::WrenchStamped& m) override {
    at(topic).publish(m);
  }
  void put(const std::string& topic, const ros::Time&, const BodyStates& m) override { at(topic).publish(m); }
  void put(const std::string& topic, const ros::Time&, const SolverState& m) override { at(topic).publish(m); }
  void put(const std::string& topic, const ros::Time&, const GlobalQuantities& m) override { at(topic).publish(m); }
  void put(const std::string& topic, const ros::Time&, const Cracks& m) override { at(topic).publish(m); }
  void put(const std::string& topic, const ros::Time&, const sensor_msgs::JointState& m) override {
    at(topic).publish(m);
  }
  void put(const std::string& topic, const ros::Time&, const RobotStates& m) override { at(topic).publish(m); }
  void put(const std::string& topic, const ros::Time&, const tf2_msgs::TFMessage& m) override { at(topic).publish(m); }
  void put(const std::string& topic, const ros::Time&, const sensor_msgs::PointCloud2& m) override {
    at(topic).publish(m);
  }
  void put(const std::string& topic, const ros::Time&, const Command& m) override { at(topic).publish(m); }
  void put(const std::string& topic, const ros::Time&, const JointCommand& m) override { at(topic).publish(m); }
  void put(const std::string& topic, const ros::Time&, const StateSet& m) override { at(topic).publish(m); }
  void put(const std::string& topic, const ros::Time&, const HeightMap& m) override { at(topic).publish(m); }
  void put(const std::string& topic, const ros::Time&, const Volumes& m) override { at(topic).publish(m); }
  void put(const std::string& topic, const ros::Time&, const sensor_msgs::Image& m) override { at(topic).publish(m); }

 private:
  ros::Publisher& at(const std::string& topic) { return publishers_.at(topic); }

  ros::NodeHandle node_;
  std::map<std::string, ros::Publisher> publishers_;
};

}  // namespace mpm_ros
