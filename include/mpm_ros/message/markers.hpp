// Rigid bodies and contact forces for RViz.
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "mpm/simulation/report.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm_ros {

/// The triangles of every rigid body in the body's own frame, locked to it: sent once, moved by /tf.
visualization_msgs::MarkerArray shape_markers(const mpm::Simulation& simulation);

/// One arrow a body, from its origin along the mean contact force; removed where the force is zero.
class ForceMarkers {
 public:
  /// `scale` [m/N]; zero: the largest force met so far is drawn `longest` [m] long.
  ForceMarkers(double scale, double longest) : scale_(scale), longest_(longest) {}
  visualization_msgs::MarkerArray arrows(const std::vector<mpm::ContactReport>& contacts,
                                         const std::vector<mpm::BodyState>& bodies, const std::string& world_frame,
                                         const ros::Time& stamp);

 private:
  double scale_;
  double longest_;
  double largest_force_ = 0.0;
};

}  // namespace mpm_ros
