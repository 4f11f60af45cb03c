// Particles as one PointCloud2, laid out without padding, so that numpy.frombuffer reads it in one call:
//   numpy.frombuffer(cloud.data, dtype=[("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("id", "<u4"), ("vx", "<f4"), …])
#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <string>
#include <vector>

#include "mpm/simulation/simulation.hpp"

namespace mpm_ros {

/// Choice of the particles and of their fields that are written.
struct ParticleSelection {
  std::vector<std::string> fields;       ///< names that mpm::Simulation::particle_field() knows, beside x, y, z, id
  mpm::ParticleChoice choice;            ///< choice of particles
  mpm::Vec3 origin = mpm::Vec3::Zero();  ///< from which places ("x", "x0", …) are written [m]
};

/// Reason why a selection cannot be used, naming the nearest field or the range; empty when it can.
std::string problem_of(const ParticleSelection& selection);

/// Fills the cloud: x, y, z (float32), id (uint32), then the fields (float32), in the order of the columns, which hold
/// x, y and z first.
void fill_cloud(const std::vector<std::string>& fields, const mpm::ParticleColumns& columns,
                sensor_msgs::PointCloud2& cloud);

/// Reads a simulation's particles; keeps its buffers from one call to the next.
class ParticleCloud {
 public:
  explicit ParticleCloud(ParticleSelection selection);
  /// The header is left to the caller.
  const sensor_msgs::PointCloud2& read(const mpm::Simulation& simulation);
  /// The same of this rank's own particles, as they lie in memory.
  const sensor_msgs::PointCloud2& read_own(const mpm::Simulation& simulation);
  sensor_msgs::PointCloud2& message() { return cloud_; }

 private:
  /// Places from the origin; takes the columns of what float32 left of them away.
  void move_places();
  ParticleSelection selection_;
  /// The columns of a place and of its rest, with the origin's coordinate; none where the origin is the world's.
  struct Place {
    std::size_t column, rest;
    double origin;
  };
  std::vector<Place> places_;
  std::vector<std::string> names_;  ///< names of the columns
  mpm::ParticleColumns columns_;
  sensor_msgs::PointCloud2 cloud_;
};

}  // namespace mpm_ros
