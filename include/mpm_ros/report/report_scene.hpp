// Facts on the run from the scene's text, which every bag carries: when it was to end, by which method it was solved,
// and how heavy its particles are. Independent of what the solver recorded.
#pragma once

#include <mpm_ros/RunInfo.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mpm/math/geometry.hpp"
#include "mpm/particles/particle_scalar.hpp"

namespace mpm_ros {

struct SceneFacts {
  std::optional<double> end;  ///< [s] simulated time that the run was to reach; none: until stopped
  std::string method;         ///< "3D, uGIMP, USAVG, FLIP 0.998, …"; empty: the text could not be read
  bool axisymmetric = false;
  mpm::Vec3 gravity = mpm::Vec3::Zero();               ///< [m/s^2]
  mpm::Precision precision = mpm::Precision::float64;  ///< precision of the particles
  bool ground_follows = false;                         ///< particles come and go
};

/// A text that this version does not read (or none) gives facts without values.
SceneFacts scene_facts(const RunInfo& info);

/// Masses of the particles in the order of their ids [kg], as the run had them: a particle that starts under stress
/// holds as much as its volume under that stress. Takes the memory of the run.
/// @throws mpm::Error when the scene cannot be read or built
std::vector<double> particle_masses(const RunInfo& info);

}  // namespace mpm_ros
