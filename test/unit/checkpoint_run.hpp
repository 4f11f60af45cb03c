// Small scenes for tests of checkpoints, and commands in the course of their runs.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm::test {

/// A temporary folder that is removed with the object.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "mpm_checkpoint_XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

// Blocks that cross several cells in a dozen sync periods, so that particles are sorted more than once.
const char* const kPlane = R"yaml(
geometry: plane_strain
grid: {cell: 0.1, min: [0, 0], max: [1.6, 1.6]}
time: {end: 1, sync: 5 ms, cfl: 0.4}
method: {shape: ugimp}
gravity: [0, -9.81]
materials: [{name: rubber, density: 1000, law: neo_hookean, young: 100 kPa, poisson: 0.3}]
bodies: [{name: block, material: rubber, shape: {box: {min: [0.3, 0.3], max: [0.7, 0.7]}}, initial: {velocity: ["4+z", "-2-2*x"]}}]
boundaries: {z_min: {friction: 0.4}}
metrics: {faster: {mean: vx, rate: {from: 10 ms, to: 1}}, lowest: {min: z}}
)yaml";

const char* const kPair = R"yaml(
geometry: plane_strain
grid: {cell: 0.1, min: [0, 0], max: [1.6, 1.6]}
time: {end: 1, sync: 5 ms, cfl: 0.4}
method: {shape: ugimp}
materials: [{name: rubber, density: 1000, law: neo_hookean, young: 100 kPa, poisson: 0.3}]
bodies:
  - {name: left, material: rubber, shape: {box: {min: [0.2, 0.3], max: [0.6, 0.7]}}, initial: {velocity: [4, 1]}}
  - {name: right, material: rubber, shape: {box: {min: [0.6, 0.3], max: [1, 0.7]}}, initial: {velocity: [1, 0]}}
)yaml";

struct Case {
  std::string name;
  const char* scene;
  std::vector<std::string> changes;
};

inline void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

/// Gives commands, so that the state also contains values that the scene does not define.
inline void command(Simulation& simulation, int period) {
  const int body = simulation.find_body("rod");
  if (body < 0) return;
  if (period == 3) simulation.command_velocity(body, {Vec3(1.0, 0.0, 0.2), Vec3::Zero()});
  if (period == 6) {
    Pose target = simulation.bodies()[body].pose;
    target.position.x() += 0.04;
    simulation.command_pose(body, target, simulation.time() + 4 * simulation.sync_period());
  }
}

inline SimulationDefinition definition_of(const Case& one) {
  return build(parse_scene(one.scene, "checkpoint.yaml", one.changes));
}

inline void run(Simulation& simulation, int from, int to) {
  for (int period = from; period < to; ++period) {
    command(simulation, period);
    simulation.advance();
    // Contact averages since an earlier report are part of the state.
    if (period == 4 && simulation.find_body("rod") >= 0) simulation.take_contact(0);
  }
}

}  // namespace mpm::test
