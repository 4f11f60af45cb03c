// Rigid bodies and contact forces for RViz.
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <limits>
#include <string>
#include <vector>

#include "mpm/definition/report.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm_ros {

/// The triangles of every rigid body in the body's own frame, locked to it: sent once, moved by /tf.
visualization_msgs::MarkerArray shape_markers(const mpm::Simulation& simulation);

/// The faces of every crack as lines in the plane of the scene.
visualization_msgs::MarkerArray crack_markers(const std::vector<mpm::CrackReport>& cracks,
                                              const std::string& world_frame, const ros::Time& stamp);

/// A force for people: three digits and a prefix, "537 N", "1.24 kN", "35.0 mN".
std::string force_text(double newtons);

/// Height of the highest point of every rigid body, by its bounds [m]; infinite for one without end.
std::vector<double> tops_of(const mpm::Simulation& simulation);

/// For each body that something presses on: an arrow along the mean contact force, a ball at its foot, which is the
/// centre of pressure, and the force's size at its head, above the body where that would hide it; where that is above
/// the domain, and so out of the picture, beside the arrow at the domain's top. They go when the contact ends.
class ForceMarkers {
 public:
  /// `scale` [m/N]; zero: the largest force met so far is drawn `longest` [m] long. `ceiling`: top of the domain [m].
  ForceMarkers(double scale, double longest, double ceiling = std::numeric_limits<double>::infinity())
      : scale_(scale), longest_(longest), ceiling_(ceiling) {}
  /// `tops`: tops_of() the bodies; without them sizes stay at the heads.
  visualization_msgs::MarkerArray markers(const std::vector<mpm::ContactReport>& contacts,
                                          const std::string& world_frame, const ros::Time& stamp,
                                          const std::vector<double>& tops = {});

 private:
  double scale_;
  double longest_;
  double ceiling_;
  double largest_force_ = 0.0;
};

}  // namespace mpm_ros
