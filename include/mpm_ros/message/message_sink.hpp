// Receivers of a run's messages: publishers, a bag.
#pragma once

#include <geometry_msgs/WrenchStamped.h>
#include <mpm_ros/BodyStates.h>
#include <mpm_ros/Command.h>
#include <mpm_ros/ContactForces.h>
#include <mpm_ros/Cracks.h>
#include <mpm_ros/GlobalQuantities.h>
#include <mpm_ros/RunInfo.h>
#include <mpm_ros/SolverState.h>
#include <ros/time.h>
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

  virtual void put(const std::string& topic, const ros::Time& stamp, const RunInfo& message) = 0;
  virtual void put(const std::string& topic, const ros::Time& stamp,
                   const visualization_msgs::MarkerArray& message) = 0;
  virtual void put(const std::string& topic, const ros::Time& stamp, const ContactForces& message) = 0;
  virtual void put(const std::string& topic, const ros::Time& stamp, const geometry_msgs::WrenchStamped& message) = 0;
  virtual void put(const std::string& topic, const ros::Time& stamp, const BodyStates& message) = 0;
  virtual void put(const std::string& topic, const ros::Time& stamp, const SolverState& message) = 0;
  /// Not every sink has a place for them.
  virtual void put(const std::string&, const ros::Time&, const GlobalQuantities&) {}
  virtual void put(const std::string&, const ros::Time&, const Cracks&) {}
  virtual void put(const std::string& topic, const ros::Time& stamp, const tf2_msgs::TFMessage& message) = 0;
  virtual void put(const std::string& topic, const ros::Time& stamp, const sensor_msgs::PointCloud2& message) = 0;
  virtual void put(const std::string& topic, const ros::Time& stamp, const Command& message) = 0;
};

}  // namespace mpm_ros
