// Helpers for the verification of contact between deformable bodies: simulations of scenes given as text.
#pragma once

#include <string>

#include "scene_run.hpp"

namespace verification {

/// A simulation of the scene given as text.
inline mpm::Simulation from_text(const std::string& text, int threads = 1) {
  return mpm::Simulation(mpm::build(mpm::parse_scene(text, "test.yaml")), {threads});
}

/// Mean of a field over a body.
inline double mean_of(const mpm::Simulation& simulation, const std::string& name, const std::string& body) {
  const std::vector<double> values = field(simulation, name);
  const auto [first, last] = simulation.body_ids(body);
  double sum = 0.0;
  for (std::uint64_t i = first; i < last; ++i) sum += values[i];
  return sum / static_cast<double>(last - first);
}

}  // namespace verification
