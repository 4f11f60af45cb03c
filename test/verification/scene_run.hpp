// Functions that run the scenes of the verification tests: test/verification/scenes/NAME.yaml, or a shipped scene.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"
#include "test_files.hpp"

namespace verification {

/// A simulation of a scene; `overrides` have the form of run_scene's --set: "grid.cell=0.1".
inline mpm::Simulation start(const std::string& name, const std::vector<std::string>& overrides = {}, int threads = 0) {
  const std::filesystem::path file = source_file("test/verification/scenes/" + name + ".yaml");
  const mpm::Scene scene = mpm::load_scene(std::filesystem::exists(file) ? file.string() : name, overrides);
  return mpm::Simulation(mpm::build(scene), {threads});
}

/// Values of a particle field, in the order of ids.
inline std::vector<double> field(const mpm::Simulation& simulation, const std::string& name) {
  std::vector<double> values;
  simulation.particle_field(name, values);
  return values;
}

/// A number of the run that a module reports; 0 when none has that name.
inline double number(const mpm::Simulation& simulation, const std::string& name) {
  for (const mpm::NamedNumber& one : simulation.state().numbers) {
    if (one.name == name) return one.value;
  }
  return 0.0;
}

/// Simulated time [s].
inline double seconds(const mpm::Simulation& simulation) { return 1e-9 * static_cast<double>(simulation.time()); }

/// Runs until `end` [s].
inline void run_until(mpm::Simulation& simulation, double end) {
  while (seconds(simulation) < end - 1e-12) simulation.advance();
}

}  // namespace verification
