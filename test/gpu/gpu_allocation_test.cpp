// No step after the first allocates memory, also where particles are sorted anew. Cost: 1 s.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "gpu_method_scenes.hpp"

namespace gpu_allocation_test {

std::atomic<long> allocations{0};

void* counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  ++allocations;
  return memory;
}

}  // namespace gpu_allocation_test

// noinline, because gcc warns of mismatched new and delete when they are inlined.
[[gnu::noinline]] void* operator new(std::size_t size) { return gpu_allocation_test::counted(std::malloc(size)); }
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto multiple = static_cast<std::size_t>(alignment);
  return gpu_allocation_test::counted(std::aligned_alloc(multiple, (size + multiple - 1) / multiple * multiple));
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace gpu_allocation_test {

TEST(GpuAllocation, NoneInAStepAfterTheFirst) {
  for (const auto scene :
       {gpu_scenes::falling_block, gpu_scenes::column_apic, gpu_scenes::column_friction, gpu_scenes::column_mixture,
        gpu_scenes::column_damped, gpu_scenes::block_loaded, gpu_scenes::dam_in_plane}) {
    const mpm::SimulationDefinition d = scene(mpm::Precision::float64);
    const double dt = gpu_scenes::step_of(d);
    mpm::SimulationProbe solver(d);
    mpm_gpu::DeviceRun<double> run(d, solver.sets());
    run.solver().step(dt);
    run.solver().look();
    const long before = allocations, sorts = run.solver().sorts();
    for (int i = 0; i < 60; ++i) run.solver().step(dt);
    run.solver().look();
    EXPECT_EQ(allocations - before, 0);
    EXPECT_GT(run.solver().sorts(), sorts);
  }
}

}  // namespace gpu_allocation_test
