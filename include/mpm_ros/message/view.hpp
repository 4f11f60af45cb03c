// Place that RViz should look from: made to fit a run, whatever the size of its scene.
#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <string>

#include "mpm/math/geometry.hpp"

namespace mpm_ros {

/// View of RViz's view controller "Orbit", and of its displays.
struct View {
  bool planar = false;                  ///< seen from the front: the eye towards -y, x to the right
  mpm::Vec3 focus = mpm::Vec3::Zero();  ///< point in the middle of the picture [m]
  double distance = 1.0;                ///< distance of the eye from it [m]
  double yaw = 0.0;                     ///< angle of the eye about z from x [rad]
  double pitch = 0.0;                   ///< angle of the eye above the horizon [rad]
  double floor = 0.0;                   ///< height of the lowest particle [m]
  double particle_size = 0.01;          ///< [m]
  std::string frame;                    ///< frame of the particles; empty: that of the configuration
  std::string field;                    ///< that colours the particles; empty: none is there
  std::string coloured;  ///< topic of the cloud with colours (rgb); empty: RViz colours the particles' own
  std::string bar;       ///< topic of the colour bar's markers; empty: there is none

  /// Radius of the sphere that fills the picture [m].
  double radius() const;
  /// Directions of the picture, as unit vectors.
  mpm::Vec3 right() const;
  mpm::Vec3 up() const;
  /// Cell of the reference grid: a round number [m].
  double grid_cell() const;
};

/// True for a particle field that transport moves, which a scene is about when it names it first.
bool is_transported(const std::string& field);

/// All of the domain in the picture (empty: of the particles), each particle as large as their spacing; planar scenes
/// (all y equal) from the front.
/// `field`: wished for; when the cloud does not have it (or it is empty) what is transported, if the cloud's own fields
/// begin with it, else the first of speed, p, and the cloud's own.
View view_of(const sensor_msgs::PointCloud2& cloud, const std::string& field = {}, const mpm::Box& domain = {});

/// An RViz configuration (YAML text) with the view put in: camera, particles, a reference grid below them (behind them
/// in a planar scene) whose lines have round coordinates, axes of the frames; its topics below `name_space`, which ends
/// with a slash. With a colour bar the camera looks a little to the right, so that the bar is in the picture too.
/// @throws std::runtime_error when it is not such a configuration.
std::string with_view(const std::string& configuration, const View& view, const std::string& name_space);

}  // namespace mpm_ros
