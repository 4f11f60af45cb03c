// Steps a second of an elastic block and of a block of soil, whose cells share a mean stress, that fall on a floor, by
// number of particles and precision. Beside them the solver on all cores of the same machine, and the memory a
// particle. On a card also the time of each kernel, in steps that are waited for, and how much of a step the card would
// take to read and write all numbers of the particles once, at the speed of its own copies. gpu_benchmark
// [PARTICLES...]: 64000, 1000000 and 4000000 where none is given.
#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <cstdlib>

#include "../../test/gpu/gpu_scenes.hpp"
#include "mpm/simulation/threads.hpp"

namespace {

using mpm::SimulationDefinition;
using Clock = std::chrono::steady_clock;

#ifdef MPM_CUDA
constexpr int kSteps = 100, kStepsOfProfile = 20;
constexpr double kMemory = 80e9;  ///< memory of a card of today [bytes]
#else
constexpr int kSteps = 5;
#endif
constexpr int kStepsHere = 5;

/// Time of a step [s], of so many after a few.
template <class Step>
double time_of(int steps, Step&& step) {
  step((steps + 4) / 5);
  const auto begin = Clock::now();
  step(steps);
  return std::chrono::duration<double>(Clock::now() - begin).count() / steps;
}

/// A cube of about so many particles, eight in a cell, that moves down onto a fixed floor in a domain around it.
SimulationDefinition cube(long particles, bool soil, mpm::Precision precision) {
  SimulationDefinition d = gpu_scenes::empty_scene(mpm::GeometryKind::solid, precision);
  const double cells = std::round(std::cbrt(static_cast<double>(particles) / 8.0));
  d.grid.max = mpm::Vec3::Constant(d.grid.cell.x() * (cells + 8.0));
  d.walls[4].kind = mpm::WallKind::fixed;
  if (soil) {
    mpm::DruckerPragerDefinition law;
    law.elasticity = {1e6, 0.3};
    law.friction_angle = 0.6;
    d.method.average_stress = true;
    d.materials = {{"soil", 1600.0, law}};
  } else {
    mpm::NeoHookeanDefinition law;
    law.elasticity = {1e6, 0.3};
    d.materials = {{"elastic", 1000.0, law}};
  }
  const mpm::Vec3 from(4.0, 4.0, 0.1), to = from + mpm::Vec3::Constant(cells);
  d.bodies = {gpu_scenes::block(d, d.materials[0].name, from, to, {0.0, 0.0, -1.0})};
  return d;
}

template <class T>
void measure(long particles, bool soil) {
  const SimulationDefinition d =
      cube(particles, soil, sizeof(T) == 8 ? mpm::Precision::float64 : mpm::Precision::float32);
  mpm::SimulationProbe solver(d, mpm::machine_threads());
  mpm_gpu::DeviceRun<T> run(d, solver.sets());
  const double dt = gpu_scenes::step_of(d), count = static_cast<double>(d.bodies[0].positions.size());
  const auto advance = [&](int steps) {
    for (int i = 0; i < steps; ++i) run.solver().step(dt);
    run.solver().look();  // waits for all of them
  };
  const double seconds = time_of(kSteps, advance);
  const double here = time_of(kStepsHere, [&](int steps) {
    for (int i = 0; i < steps; ++i) solver.step(dt);
  });
  const double bytes = static_cast<double>(run.solver().bytes()) / count;
  fmt::print("{:<8} {:<6} {:>9.0f} {:>10.3f} {:>12.1f} {:>12.1f} {:>9.0f} {:>6}\n", soil ? "soil" : "elastic",
             sizeof(T) == 8 ? "double" : "single", count, 1e3 * seconds, 1e-6 * count / seconds, 1e-6 * count / here,
             bytes, run.solver().sorts());
#ifdef MPM_CUDA
  const double moved = 2.0 * static_cast<double>(run.solver().particle_bytes());
  fmt::print(
      "    all numbers of particles read and written once: {:.0f} % of a step; {:.0f} million fit in {:.0f} GB\n",
      100.0 * moved / mpm_gpu::card::bytes_per_second() / seconds, 1e-6 * kMemory / bytes, 1e-9 * kMemory);
  mpm_gpu::card::profile(true);
  advance(kStepsOfProfile);
  for (const mpm_gpu::card::Row& row : mpm_gpu::card::profiled()) {
    fmt::print("    {:<40} {:>8.1f} launches {:>9.3f} ms a step\n", row.name,
               static_cast<double>(row.launches) / kStepsOfProfile, 1e3 * row.seconds / kStepsOfProfile);
  }
  mpm_gpu::card::profile(false);
#endif
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
#ifdef MPM_CUDA
    fmt::print("card: {}; copies move {:.0f} GB/s, read and written\n", mpm_gpu::card::name(),
               1e-9 * mpm_gpu::card::bytes_per_second());
#endif
    fmt::print("{:<8} {:<6} {:>9} {:>10} {:>12} {:>12} {:>9} {:>6}\n", "scene", "", "particles", "ms a step",
               "M p-steps/s", "all cores", "B a part.", "sorts");
    std::vector<long> counts;
    for (int i = 1; i < argc; ++i) counts.push_back(std::atol(argv[i]));
    if (counts.empty()) counts = {64'000, 1'000'000, 4'000'000};
    for (const long count : counts) {
      for (const bool soil : {false, true}) {
        measure<double>(count, soil);
        measure<float>(count, soil);
      }
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  return 0;
}
