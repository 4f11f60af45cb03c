// Between the solver's plain values and ROS messages. Free functions, no state, no ROS connection.
#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/Vector3.h>
#include <geometry_msgs/Wrench.h>
#include <mpm_ros/BodyState.h>
#include <mpm_ros/ContactForce.h>
#include <mpm_ros/ContactPair.h>
#include <mpm_ros/Cracks.h>
#include <mpm_ros/SolverState.h>
#include <mpm_ros/Volumes.h>
#include <tf2_msgs/TFMessage.h>

#include <string>
#include <vector>

#include "mpm/definition/report.hpp"
#include "mpm/rigid/motion.hpp"
#include "mpm/volumes/volume_definition.hpp"

namespace mpm_ros {

geometry_msgs::Vector3 to_vector(const mpm::Vec3& value);
geometry_msgs::Point to_point(const mpm::Vec3& value);
geometry_msgs::Pose to_message(const mpm::Pose& pose);
geometry_msgs::Twist to_message(const mpm::Twist& twist);
geometry_msgs::Wrench to_message(const mpm::Wrench& wrench);

mpm::Vec3 from_message(const geometry_msgs::Vector3& message);
mpm::Vec3 from_message(const geometry_msgs::Point& message);
mpm::Wrench from_message(const geometry_msgs::Wrench& message);
mpm::Twist from_message(const geometry_msgs::Twist& message);
/// The pose of the child frame in its parent, as it stands.
geometry_msgs::Pose to_pose(const geometry_msgs::Transform& transform);
/// As it stands; see checked_pose() for what comes from outside.
mpm::Pose from_message(const geometry_msgs::Pose& message);

/// Largest difference from 1 of the norm of a quaternion that is still taken for a rotation.
constexpr double kQuaternionTolerance = 1e-3;

/// Reason why a twist cannot be used, or empty: "linear.x is nan".
std::string problem_of(const geometry_msgs::Twist& message);
/// Reason why a pose cannot be used, or empty: not finite, or a quaternion whose norm is not 1 within the tolerance.
std::string problem_of(const geometry_msgs::Pose& message);
/// A pose for which problem_of() is empty, its quaternion normalised.
mpm::Pose checked_pose(const geometry_msgs::Pose& message);

mpm_ros::BodyState to_message(const mpm::BodyState& state);
mpm_ros::ContactForce to_message(const mpm::ContactReport& report);
mpm_ros::ContactPair to_message(const mpm::PairReport& report);
/// Without a header.
mpm_ros::Volumes to_message(const std::vector<mpm::VolumeReport>& volumes);
mpm_ros::Cracks to_message(const std::vector<mpm::CrackReport>& cracks, const std::vector<mpm::CrackTipReport>& tips);
/// All but the header, real_time_factor, state_hash, and what only the run knows: commands and failure.
mpm_ros::SolverState to_message(const mpm::SolverState& state);

/// Force and torque in the body's own axes (torque about its origin already), as a sensor on it would say.
mpm::Wrench in_body_axes(const mpm::Wrench& world, const mpm::Quat& orientation);

/// World to each body's frame, which has the body's name.
tf2_msgs::TFMessage to_transforms(const std::vector<mpm::BodyState>& bodies, const std::string& world_frame,
                                  const ros::Time& stamp);

/// 16 hexadecimal digits.
std::string hash_text(std::uint64_t hash);

}  // namespace mpm_ros
