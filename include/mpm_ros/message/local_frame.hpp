// The frame of clouds and markers of a scene that lies far from the world's origin, as by a map's coordinates. They are
// float32, by the message's type or in RViz, and 4,600,000 m is followed by 4,600,000.5 m there. Such a scene has a
// frame "<world>_local" in its middle, which does not move: /tf_static says where it is. Poses, forces and all else are
// of double precision, and stay in the world frame. A scene near the origin has no such frame.
#pragma once

#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <map>
#include <string>

#include "mpm/definition/definition.hpp"

namespace mpm_ros {

struct LocalFrame {
  std::string world, name;               ///< equal where the world's origin serves
  mpm::Vec3 origin = mpm::Vec3::Zero();  ///< in the world frame [m]
  bool apart() const { return name != world; }
};

/// A frame of its own where float32 cannot resolve a hundredth of a cell somewhere in the grid. Its origin is near the
/// grid's middle, in round numbers, and zero along axes where zero serves.
LocalFrame local_frame(const mpm::GridDefinition& grid, const std::string& world);

/// True for a particle field that is a place: x, y, z, and x0, y0, z0 at the start.
bool is_place(const std::string& field);
/// Note for users, one line; empty where it is the world's.
std::string note_on(const LocalFrame& frame);

/// For /tf_static.
tf2_msgs::TFMessage static_transform(const LocalFrame& frame, const ros::Time& stamp);
/// Origins [m], by the names of frames, that a message on /tf_static gives; those of turned frames are left out.
std::map<std::string, mpm::Vec3> origins_of(const tf2_msgs::TFMessage& message);

/// A cloud of that origin as it lies in the world: places ("x", "x0", …) are float64 then.
sensor_msgs::PointCloud2 in_world(const sensor_msgs::PointCloud2& cloud, const mpm::Vec3& origin);

/// Puts markers of the world frame into the local one.
void move_to(const LocalFrame& frame, visualization_msgs::MarkerArray& markers);

}  // namespace mpm_ros
