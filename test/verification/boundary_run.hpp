// Scenes of the boundary tests, written where they are used.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "scene_run.hpp"

namespace verification {

inline mpm::Simulation scene(const std::string& text, int threads = 1) {
  return mpm::Simulation(mpm::build(mpm::parse_scene(text, "boundary.yaml")), {threads});
}

/// The account of `name`: the impulse that it gave to the material since the start [N s].
inline mpm::Vec3 impulse(const mpm::Simulation& simulation, const std::string& name) {
  for (const mpm::NamedImpulse& impulse : simulation.state().audit.impulses) {
    if (impulse.name == name) return impulse.impulse;
  }
  ADD_FAILURE() << "no impulse is called " << name;
  return mpm::Vec3::Zero();
}

inline double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

}  // namespace verification
