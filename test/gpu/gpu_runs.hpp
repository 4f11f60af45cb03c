// Whole runs of the small scenes, on the processor and where a device takes the steps, and what has to agree.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "../unit/checkpoint_run.hpp"
#include "gpu_method_scenes.hpp"
#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm_gpu/device.hpp"

namespace gpu_runs {

using mpm::Simulation;
using mpm::SimulationDefinition;
using mpm::SimulationOptions;

inline constexpr int kPeriods = 8;

inline SimulationDefinition scene(SimulationDefinition (*of)(mpm::Precision)) {
  SimulationDefinition d = of(mpm::Precision::float64);
  d.time.sync = 5'000'000;
  return d;
}

inline SimulationOptions options(bool on_device) {
  SimulationOptions chosen;
  chosen.threads = 1;
  // One thread: loops of two wait for each other where the machine has other work, and the bits are the same.
  if (on_device) chosen.device = mpm_gpu::device_by(mpm_gpu::Executor(mpm_gpu::Visits::shuffled, 1));
  return chosen;
}

inline void advance(Simulation& simulation, int periods) {
  for (int i = 0; i < periods; ++i) simulation.advance();
}

inline std::vector<double> field(const Simulation& simulation, const char* name) {
  std::vector<double> values;
  simulation.particle_field(name, values);
  return values;
}

/// A number that a module reports.
inline double number(const Simulation& simulation, const std::string& name) {
  for (const mpm::NamedNumber& one : simulation.numbers()) {
    if (one.name == name) return one.value;
  }
  ADD_FAILURE() << name;
  return 0.0;
}

/// Largest difference of a field, over the largest value that it has.
inline double difference(const Simulation& a, const Simulation& b, const char* name) {
  const std::vector<double> one = field(a, name), other = field(b, name);
  double most = 0.0, size = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    most = std::max(most, std::abs(one[i] - other[i]));
    size = std::max(size, std::abs(one[i]));
  }
  EXPECT_GT(size, 0.0) << name;
  return most / size;
}

// Sums of a step differ in the last bit, and 8 sync periods of some 10 steps let that grow; nothing else differs. The
// same bound holds between two instruction sets of the processor.
inline constexpr double kRoundOff = 1e-10;

/// Clock, steps, energies and accounts.
inline void expect_sums_alike(Simulation& here, Simulation& there, double bound = kRoundOff) {
  EXPECT_EQ(here.time(), there.time());
  const mpm::SolverState a = here.state(), b = there.state();
  EXPECT_EQ(a.step.steps, b.step.steps);
  EXPECT_NEAR(a.step.dt_min, b.step.dt_min, bound * a.step.dt_min);
  EXPECT_EQ(a.step.limited_by.substr(0, 20), b.step.limited_by.substr(0, 20));
  // Potential energy of what has left a periodic axis is another until it is put back.
  const auto value = [](const mpm::EnergyReport& energy, const std::string& name) {
    return name == "around" ? 0.0 : energy.of(name) - (name == "potential" ? energy.of("around") : 0.0);
  };
  double size = 0.0;
  for (const mpm::NamedEnergy& energy : a.energy.list()) size += std::abs(energy.value);
  ASSERT_EQ(a.energy.list().size(), b.energy.list().size());
  for (const mpm::NamedEnergy& energy : a.energy.list()) {
    EXPECT_NEAR(value(a.energy, energy.name), value(b.energy, energy.name), bound * size) << energy.name;
  }
  EXPECT_EQ(b.energy.closed(), a.energy.closed());
  ASSERT_EQ(a.audit.impulses.size(), b.audit.impulses.size());
  for (std::size_t i = 0; i < a.audit.impulses.size(); ++i) {
    EXPECT_EQ(a.audit.impulses[i].name, b.audit.impulses[i].name);
    const double size = a.audit.exchanged;
    EXPECT_NEAR((a.audit.impulses[i].impulse - b.audit.impulses[i].impulse).norm(), 0.0, bound * size)
        << a.audit.impulses[i].name;
  }
  EXPECT_NEAR(a.audit.exchanged, b.audit.exchanged, bound * a.audit.exchanged);
  EXPECT_LT(b.audit.residual, bound);
}

inline void expect_alike(Simulation& here, Simulation& there, double bound = kRoundOff) {
  expect_sums_alike(here, there, bound);
  for (const char* name : {"x", "z", "vz", "j"}) EXPECT_LT(difference(here, there, name), bound) << name;
}

/// A run that goes on from a checkpoint ends with the same bits. `begin` is done with each run, `compare` with both
/// ends.
template <class Begin, class Compare>
void expect_resumes(const SimulationDefinition& d, Begin&& begin, Compare&& compare) {
  const mpm::test::Folder folder;
  const std::string file = folder.file("half.h5");
  Simulation whole(d, options(true)), first(d, options(true)), second(d, options(true));
  for (Simulation* one : {&whole, &first, &second}) begin(*one);
  advance(whole, kPeriods);
  advance(first, kPeriods / 2);
  mpm::save_checkpoint(file, first, {});
  mpm::load_checkpoint(file, second, "");
  EXPECT_EQ(first.memory_hash(), second.memory_hash());
  advance(second, kPeriods / 2);
  EXPECT_EQ(whole.state_hash(), second.state_hash());
  compare(whole, second);
}

}  // namespace gpu_runs
