// Runs of scenes with sleep, for the tests of what falls asleep.
#pragma once

#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm::test {

inline Simulation start(const std::string& text, const std::vector<std::string>& changes = {}, int threads = 1) {
  return Simulation(build(parse_scene(text, "sleep.yaml", changes)), {threads});
}

inline double number(const Simulation& run, const std::string& name) {
  for (const NamedNumber& one : run.state().numbers) {
    if (one.name == name) return one.value;
  }
  return 0.0;
}

inline std::vector<double> field(const Simulation& run, const char* name) {
  std::vector<double> values;
  run.particle_field(name, values);
  return values;
}

inline void advance_to(Simulation& run, double end) {
  while (1e-9 * static_cast<double>(run.time()) < end - 1e-9) run.advance();
}

}  // namespace mpm::test
