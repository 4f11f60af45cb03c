// Receivers of a run's messages: publishers, a bag.
#pragma once

#include <geometry_msgs/WrenchStamped.h>
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
#include <mpm_ros/Volumes.h>
#include <ros/time.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>

namespace mpm_ros {

class MessageSink {
 public:
  virtual ~MessageSink() = default;
  /// True if a message on this topic (a name of topics.hpp) is worth making.
  virtual bool wants(const std::string& topic) const = 0;
  /// True if it takes a cloud of the particles of its own rank, instead of one of all on the first. Then there is one
  /// on each rank, and they want clouds together.
  virtual bool takes_own_particles() const { return false; }

  // A sink leaves out what it has no place for.
  virtual void put(const std::string&, const ros::Time&, const RunInfo&) {}
  virtual void put(const std::string&, const ros::Time&, const visualization_msgs::MarkerArray&) {}
  virtual void put(const std::string&, const ros::Time&, const ContactForces&) {}
  virtual void put(const std::string&, const ros::Time&, const geometry_msgs::WrenchStamped&) {}
  virtual void put(const std::string&, const ros::Time&, const BodyStates&) {}
  virtual void put(const std::string&, const ros::Time&, const SolverState&) {}
  virtual void put(const std::string&, const ros::Time&, const GlobalQuantities&) {}
  virtual void put(const std::string&, const ros::Time&, const Cracks&) {}
  virtual void put(const std::string&, const ros::Time&, const tf2_msgs::TFMessage&) {}
  virtual void put(const std::string&, const ros::Time&, const sensor_msgs::PointCloud2&) {}
  virtual void put(const std::string&, const ros::Time&, const sensor_msgs::JointState&) {}
  virtual void put(const std::string&, const ros::Time&, const RobotStates&) {}
  virtual void put(const std::string&, const ros::Time&, const Command&) {}
  virtual void put(const std::string&, const ros::Time&, const JointCommand&) {}
  virtual void put(const std::string&, const ros::Time&, const StateSet&) {}
  virtual void put(const std::string&, const ros::Time&, const HeightMap&) {}
  virtual void put(const std::string&, const ros::Time&, const Volumes&) {}
  virtual void put(const std::string&, const ros::Time&, const sensor_msgs::Image&) {}
};

}  // namespace mpm_ros
