// Whole steps of small versions of the shipped scenes (cells twice as wide), sorting and step control included. The
// scene with a tool and the same scene without it show the cost of contact. An iteration is a sync period of about 80
// steps.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace {

constexpr int kTurns = 4;  ///< few enough for the block to stay in the domain

void step(benchmark::State& state, const char* scene, const std::vector<std::string>& overrides) {
  std::vector<std::string> all = overrides;
  all.emplace_back("grid.cell=0.02");
  mpm::Simulation simulation(mpm::build(mpm::load_scene(scene, all)), {static_cast<int>(state.range(0))});
  simulation.advance();  // touches memory for the first time
  const auto before = simulation.state().step.steps;
  for (auto _ : state) simulation.advance();
  const auto steps = static_cast<std::int64_t>(simulation.state().step.steps - before);
  state.SetItemsProcessed(steps * static_cast<std::int64_t>(simulation.particles()));
}

#define MPM_STEP(name, scene, ...)                    \
  BENCHMARK_CAPTURE(step, name, scene, {__VA_ARGS__}) \
      ->ArgName("threads")                            \
      ->Arg(1)                                        \
      ->Arg(2)                                        \
      ->Iterations(kTurns)                            \
      ->UseRealTime()                                 \
      ->Unit(benchmark::kMillisecond)

MPM_STEP(solid_usf, "speed_block_3d", "method.update=usf");
MPM_STEP(solid_usavg, "speed_block_3d", "method.update=usavg");
MPM_STEP(planar_usf, "speed_block_2d", "method.update=usf");
MPM_STEP(planar_usavg, "speed_block_2d", "method.update=usavg");
MPM_STEP(soil, "speed_soil_3d", "method.update=usavg");
MPM_STEP(with_tool, "speed_tool_3d", "method.update=usf");
MPM_STEP(without_tool, "speed_tool_3d", "method.update=usf", "rigid_bodies=[]");

}  // namespace
