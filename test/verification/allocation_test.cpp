// Nothing allocates in a step after the first ones: what a sync period allocates does not grow with its steps.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "mpm/simulation/simulation.hpp"

namespace {
std::atomic<long> allocations{0};
}

// noinline: inlined, gcc takes the pair for mismatched.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto multiple = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(multiple, (size + multiple - 1) / multiple * multiple)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace {

using mpm::Vec3;

// Soil at rest on a wall, touched by a box that moves along its surface and shaken by a load that is a function.
long allocations_of_a_period(double step) {
  mpm::SimulationDefinition d;
  const double h = 0.1;
  d.grid = {Vec3::Constant(h), Vec3::Zero(), Vec3::Constant(2.0)};
  d.time.sync = 20'000'000;
  d.time.step = step;
  d.gravity = {0.0, 0.0, -9.81};
  d.materials = {{"m", 1000.0, mpm::DruckerPragerDefinition{{1e5, 0.3}, 0.6, 0.1, 500.0}}};
  mpm::DeformableBody body;
  body.name = "soil";
  body.material = "m";
  body.particle_volume = h * h * h / 8.0;
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 12; ++j) {
      for (int k = 0; k < 12; ++k) body.positions.emplace_back((i + 0.5) * h / 2, (j + 0.5) * h / 2, (k + 0.5) * h / 2);
    }
  }
  d.bodies = {body};
  for (mpm::WallDefinition& wall : d.walls) wall.kind = mpm::WallKind::slip;
  mpm::RigidBodyDefinition tool;
  tool.name = "tool";
  tool.surface = mpm::make_box({0.4, 0.4, 0.4});
  tool.pose.position = {0.3, 0.3, 0.79};
  tool.velocity[0] = mpm::Function(0.1);
  d.rigid_bodies = {tool};
  d.body_forces = {{"", {mpm::Function::parse("sin(9*t)*X", {}, mpm::FunctionPlaces::present_and_start)}}};
  mpm::Simulation simulation(d, {1});
  for (int i = 0; i < 3; ++i) simulation.advance();
  const long before = allocations;
  const std::uint64_t steps_before = simulation.state().step.steps;
  const long of_state = allocations - before;
  simulation.advance();
  const long during = allocations - before - of_state;
  EXPECT_GE(simulation.state().step.steps - steps_before, static_cast<std::uint64_t>(0.02 / step));
  return during;
}

// A block that crosses the grid is sorted again and again; the tool meets new nodes all the while.
long allocations_of_a_crossing(int periods) {
  mpm::SimulationDefinition d;
  d.grid = {Vec3::Constant(0.1), Vec3::Zero(), Vec3::Constant(9.0)};
  d.time.sync = 20'000'000;
  d.materials = {{"m", 1000.0, mpm::NeoHookeanDefinition{{1e5, 0.3}}}};
  mpm::DeformableBody body;
  body.name = "block";
  body.material = "m";
  body.particle_volume = 0.1 * 0.1 * 0.1 / 8.0;
  for (int i = 0; i < 512; ++i) {
    body.positions.emplace_back(0.1 + 0.05 * (i / 64 + 0.5), 2.0 + 0.05 * (i / 8 % 8 + 0.5),
                                2.0 + 0.05 * (i % 8 + 0.5));
  }
  body.velocities.assign(512, Vec3(10.0, 0.0, 0.0));
  d.bodies = {body};
  mpm::RigidBodyDefinition tool;
  tool.name = "tool";
  tool.surface = mpm::make_box({20.0, 2.0, 2.0});  // the block slides along its top
  tool.pose.position = {0.0, 2.0, 1.0};
  d.rigid_bodies = {tool};
  mpm::Simulation simulation(d, {1});
  for (int i = 0; i < 10; ++i) simulation.advance();
  const long before = allocations;
  for (int i = 0; i < periods; ++i) simulation.advance();
  return allocations - before;
}

TEST(Allocation, SortingAndContactDoNotAllocate) {
  // What a period allocates is the same for ten and for twenty periods, two metres and four of grid.
  EXPECT_EQ(2 * allocations_of_a_crossing(10), allocations_of_a_crossing(20));
}

TEST(Allocation, StepsDoNotAllocate) { EXPECT_EQ(allocations_of_a_period(1e-3), allocations_of_a_period(2.5e-4)); }

}  // namespace
