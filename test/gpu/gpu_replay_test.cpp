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

/// A run of a scene, whose steps the host waits for or not.
template <class T>
class SteppedRun {
 public:
  explicit SteppedRun(const SimulationDefinition& d)
      : solver_(d), run_(d, solver_.sets(), Executor(Visits::shuffled, 1)) {}

  mpm_gpu::Solver<T>& solver() { return run_.solver(); }
  /// Makes a step, and shows whether the host has waited for it.
  void step(double dt, bool replays) {
    solver().let_replay(replays);
    solver().look();
    const long before = solver().steps();
    solver().step(dt);
    EXPECT_EQ(solver().steps() - before, replays ? 0 : 1);
  }
  std::vector<unsigned char> bytes() { return gpu_scenes::bytes_of(run_); }

 private:
  mpm::SimulationProbe solver_;
  DeviceRun<T> run_;
};

constexpr int kSteps = 60;

// Two sync periods, and steps of two lengths, of which each is recorded anew.
template <class T>
void expect_same_bits(SceneOf scene) {
  const SimulationDefinition d = scene(sizeof(T) == 8 ? mpm::Precision::float64 : mpm::Precision::float32);
  const double dt = gpu_scenes::step_of(d);
  SteppedRun<T> waited(d), replayed(d), mixed(d);
  std::vector<unsigned char> before;
  for (int i = 0; i < kSteps; ++i) {
    if (i == kSteps - 1) before = replayed.bytes();
    const double of_step = i % 8 == 5 ? 0.9 * dt : dt;
    if (i == kSteps / 2) {
      for (SteppedRun<T>* run : {&waited, &replayed, &mixed}) run->solver().make_room();
    }
    waited.step(of_step, false);
    replayed.step(of_step, true);
    mixed.step(of_step, i / 7 % 2 == 0);  // goes over from one to the other
  }
  EXPECT_EQ(waited.bytes(), replayed.bytes());
  EXPECT_EQ(waited.bytes(), mixed.bytes());
  EXPECT_NE(before, replayed.bytes());
  EXPECT_EQ(waited.solver().steps(), replayed.solver().steps());
  EXPECT_EQ(waited.solver().sorts(), replayed.solver().sorts());
  EXPECT_GT(replayed.solver().sorts(), 2);  // also within a period
}

/// Skips a test where nothing can be recorded: with a driver or a toolkit that has no conditions.
#define MPM_NEEDS_RECORDINGS \
  if (!mpm_gpu::card::can_record()) GTEST_SKIP() << "steps cannot be recorded here"

TEST(GpuReplay, HasTheBitsOfStepsThatAreWaitedFor) {
  MPM_NEEDS_RECORDINGS;
  expect_same_bits<double>(gpu_scenes::falling_block);
  expect_same_bits<float>(gpu_scenes::column);
  expect_same_bits<double>(gpu_scenes::two_blocks);
  expect_same_bits<double>(gpu_scenes::block_mixture);
  expect_same_bits<double>(gpu_scenes::block_usl);
  expect_same_bits<float>(gpu_scenes::column_usavg);
  expect_same_bits<float>(gpu_scenes::column_cubic);
  expect_same_bits<double>(gpu_scenes::column_stretch);
  expect_same_bits<double>(gpu_scenes::column_apic);
  expect_same_bits<double>(gpu_scenes::column_fmpm);
  expect_same_bits<float>(gpu_scenes::blocks_xpic);
  expect_same_bits<float>(gpu_scenes::column_friction);
}

/// A cloud that flies apart, to more blocks than there is room for at first.
SimulationDefinition cloud() {
  SimulationDefinition d = gpu_scenes::falling_block(mpm::Precision::float64);
  d.grid.max = mpm::Vec3::Constant(9.6);
  for (mpm::WallDefinition& wall : d.walls) wall.kind = mpm::WallKind::none;
  d.gravity.setZero();
  mpm::DeformableBody& body = d.bodies[0];
  const mpm::Vec3 centre(5.0, 5.0, 5.0), shift = centre - body.positions[body.positions.size() / 2];
  for (std::size_t p = 0; p < body.positions.size(); ++p) {
    body.positions[p] += shift;
    body.velocities[p] = 40.0 * (body.positions[p] - centre);
  }
  std::get<mpm::NeoHookeanDefinition>(d.materials[0].law).elasticity.young = 1.0;
  return d;
}
constexpr double kStepOfCloud = 1e-3;

// The table moves to larger memory, and what was recorded of the smaller one is not replayed any more.
TEST(GpuReplay, GoesOnInALargerTable) {
  MPM_NEEDS_RECORDINGS;
  SteppedRun<double> waited(cloud()), replayed(cloud());
  const std::size_t before = replayed.solver().bytes();
  for (int i = 0; i < 120; ++i) {
    if (i % 5 == 0) {
      for (SteppedRun<double>* run : {&waited, &replayed}) run->solver().make_room();
    }
    waited.step(kStepOfCloud, false);
    replayed.step(kStepOfCloud, true);
  }
  EXPECT_GT(replayed.solver().bytes(), before);
  EXPECT_EQ(waited.bytes(), replayed.bytes());
}

// Runs of one device in turn: each has memory of its own, also what sorts take.
TEST(GpuReplay, RunsDoNotDisturbEachOther) {
  MPM_NEEDS_RECORDINGS;
  const SimulationDefinition d = gpu_scenes::falling_block(mpm::Precision::float64);
  const double dt = gpu_scenes::step_of(d);
  SteppedRun<double> alone(d), beside(d);
  for (int i = 0; i < kSteps; ++i) alone.step(dt, true);
  for (int i = 0; i < kSteps / 2; ++i) beside.step(dt, true);
  {
    SteppedRun<double> larger(cloud());
    for (int i = 0; i < 8; ++i) {
      larger.solver().make_room();
      larger.step(kStepOfCloud, true);
      beside.step(dt, true);
    }
  }
  for (int i = kSteps / 2 + 8; i < kSteps; ++i) beside.step(dt, true);
  EXPECT_EQ(alone.bytes(), beside.bytes());
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
  const std::string waited = error_of(cloud(), false, kStepOfCloud, kStepOfCloud, 200);
  EXPECT_NE(waited.find("blocks of the grid"), std::string::npos) << waited;
  EXPECT_EQ(error_of(cloud(), true, kStepOfCloud, kStepOfCloud, 200), waited);
}

}  // namespace gpu_replay_test
