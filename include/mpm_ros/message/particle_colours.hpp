// Colours of a particle cloud for RViz, and their colour bar. RViz itself takes the smallest and the largest value of
// each cloud, where one particle that flies away leaves all others in one colour, and shows no scale. Here the ends of
// the range are the 1st and the 99th per cent of the values; what lies beyond has the colour of the end. The range
// widens at once and narrows slowly, so that the picture does not flicker.
#pragma once

#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "mpm_ros/message/view.hpp"

namespace mpm_ros {

class ParticleColours {
 public:
  explicit ParticleColours(std::string field) : field_(std::move(field)) {}

  /// The cloud's particles with x, y, z and rgb (float32 whose bytes are 0, red, green, blue, as RViz reads it), after
  /// the range took up its values. Without the field (float32) all have the colour of the lower end.
  const sensor_msgs::PointCloud2& colour(const sensor_msgs::PointCloud2& cloud);
  double low() const { return low_; }
  double high() const { return high_; }
  /// A bar right of what `view` shows, upright in its picture, with the field's name and unit, the values at its ends,
  /// and the size of the reference grid's cells.
  visualization_msgs::MarkerArray bar(const View& view, const std::string& frame) const;

 private:
  void widen(std::vector<float>& values);

  std::string field_;
  bool begun_ = false;
  double low_ = 0.0, high_ = 0.0;  // ends of the range [unit of the field]
  std::vector<float> values_;
  sensor_msgs::PointCloud2 coloured_;
};

}  // namespace mpm_ros
