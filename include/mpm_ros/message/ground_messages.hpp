// A map of the ground's height as messages: mpm_ros/HeightMap, an organised cloud and an image. Where there is no
// ground they have NaN.
#pragma once

#include <mpm_ros/HeightMap.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <vector>

#include "mpm/rigid/surface.hpp"
#include "mpm_ros/message/local_frame.hpp"

namespace mpm_ros {

/// `level`: height from which the message counts its own [m], so that float32 resolves them; it is origin.z.
HeightMap to_message(const mpm::HeightGrid& map, double level);
/// Fields x, y, z and change, float32 [m]: a row of points for each row of the map, from low y on. `before`: heights at
/// the start, as many as the map's. Points are in the local frame.
sensor_msgs::PointCloud2 to_cloud(const mpm::HeightGrid& map, const std::vector<double>& before,
                                  const LocalFrame& frame);
/// Heights [m] as 32FC1, as seen from above with y up: the first row is that of the highest y.
sensor_msgs::Image to_image(const mpm::HeightGrid& map);

}  // namespace mpm_ros
