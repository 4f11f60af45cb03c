// Steps that are recorded and replayed, which the host does not wait for, against those that it waits for. Cost: 6 s.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gpu_method_scenes.hpp"
#include "mpm/simulation/simulation.hpp"

namespace gpu_replay_test {

using mpm::SimulationDefinition;
using mpm_gpu::DeviceRun;
using mpm_gpu::Executor;
using mpm_gpu::Visits;
using SceneOf = SimulationDefinition (*)(mpm::Precision);

/// A run of so many steps, in two sync periods; the host waits for each step or not.
template <class T>
struct Ended {
  std::vector<unsigned char> bytes;
  long steps, sorts;
};
template <class T>
Ended<T> end_of(SceneOf scene, bool replays, int steps) {
  const SimulationDefinition d = scene(sizeof(T) == 8 ? mpm::Precision::float64 : mpm::Precision::float32);
  mpm::SimulationProbe solver(d);
  DeviceRun<T> run(d, solver.sets(), Executor(Visits::shuffled, 1));
  run.solver().let_replay(replays);
  const double dt = gpu_scenes::step_of(d);
  for (int i = 0; i < steps; ++i) {
    if (i == steps / 2) run.solver().make_room();
    run.solver().step(i % 3 == 0 ? 0.9 * dt : dt);  // one of another length is recorded anew
  }
  run.solver().look();
  return {gpu_scenes::bytes_of(run), run.solver().steps(), run.solver().sorts()};
}

template <class T>
void expect_same_bits(SceneOf scene) {
  constexpr int kSteps = 60;
  const Ended<T> waited = end_of<T>(scene, false, kSteps), replayed = end_of<T>(scene, true, kSteps);
  EXPECT_EQ(waited.bytes, replayed.bytes);
  EXPECT_EQ(waited.steps, replayed.steps);
  EXPECT_EQ(waited.sorts, replayed.sorts);
  EXPECT_GT(replayed.sorts, 2);  // also within a period
  EXPECT_NE(end_of<T>(scene, true, kSteps - 1).bytes, replayed.bytes);
}

TEST(GpuReplay, HasTheBitsOfStepsThatAreWaitedFor) {
  expect_same_bits<double>(gpu_scenes::falling_block);
  expect_same_bits<float>(gpu_scenes::column);
  expect_same_bits<double>(gpu_scenes::two_blocks);
  expect_same_bits<double>(gpu_scenes::block_usl);
  expect_same_bits<float>(gpu_scenes::column_usavg);
  expect_same_bits<float>(gpu_scenes::column_cubic);
  expect_same_bits<double>(gpu_scenes::column_stretch);
  expect_same_bits<double>(gpu_scenes::column_apic);
  expect_same_bits<double>(gpu_scenes::column_fmpm);
  expect_same_bits<float>(gpu_scenes::blocks_xpic);
  expect_same_bits<float>(gpu_scenes::column_friction);
}

/// Returns what ends a run of which the second half of the steps have another length.
std::string error_of(const SimulationDefinition& d, bool replays, double first, double second, int steps) {
  mpm::SimulationProbe solver(d);
  DeviceRun<double> run(d, solver.sets());
  run.solver().let_replay(replays);
  try {
    for (int i = 0; i < steps; ++i) run.solver().step(i < steps / 2 ? first : second);
    run.solver().look();
  } catch (const mpm_gpu::GpuError& error) {
    return error.what();
  }
  return "";
}

// The host hears of it many steps later, in which nothing may be done with a particle that is in no cell.
TEST(GpuReplay, FailsByTheSameName) {
  const SimulationDefinition d = gpu_scenes::falling_block(mpm::Precision::float64);
  const double first = gpu_scenes::step_of(d);
  for (const double second : {0.03, 10.0}) {  // turned inside out, outside
    const std::string waited = error_of(d, false, first, second, 40);
    EXPECT_NE(waited.find("shorten the time step"), std::string::npos) << waited;
    EXPECT_EQ(error_of(d, true, first, second, 40), waited);
  }
}

TEST(GpuReplay, RefusesWhatHasNoRoomByTheSameName) {
  SimulationDefinition d = gpu_scenes::falling_block(mpm::Precision::float64);
  d.grid.max = mpm::Vec3::Constant(9.6);
  for (mpm::WallDefinition& wall : d.walls) wall.kind = mpm::WallKind::none;
  d.gravity.setZero();
  mpm::DeformableBody& body = d.bodies[0];
  const mpm::Vec3 centre(5.0, 5.0, 5.0), shift = centre - body.positions[body.positions.size() / 2];
  for (std::size_t p = 0; p < body.positions.size(); ++p) {
    body.positions[p] += shift;
    body.velocities[p] = 40.0 * (body.positions[p] - centre);  // a cloud that flies apart
  }
  std::get<mpm::NeoHookeanDefinition>(d.materials[0].law).elasticity.young = 1.0;
  const std::string waited = error_of(d, false, 1e-3, 1e-3, 200);
  EXPECT_NE(waited.find("blocks of the grid"), std::string::npos) << waited;
  EXPECT_EQ(error_of(d, true, 1e-3, 1e-3, 200), waited);
}

}  // namespace gpu_replay_test
