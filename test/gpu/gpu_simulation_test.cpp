// A whole simulation whose steps a device takes: its clock, step limits, accounts, fields and checkpoints are those of
// a run on the processor. Cost: 5 s.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "../unit/checkpoint_run.hpp"
#include "gpu_method_scenes.hpp"
#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm_gpu/device.hpp"

namespace gpu_simulation_test {

using mpm::Simulation;
using mpm::SimulationDefinition;
using mpm::SimulationOptions;

constexpr int kPeriods = 8;

SimulationDefinition scene(SimulationDefinition (*of)(mpm::Precision)) {
  SimulationDefinition d = of(mpm::Precision::float64);
  d.time.sync = 5'000'000;
  return d;
}

SimulationOptions options(bool on_device) {
  SimulationOptions chosen;
  chosen.threads = 1;
  if (on_device) chosen.device = mpm_gpu::device_by(mpm_gpu::Executor(mpm_gpu::Visits::shuffled, 2));
  return chosen;
}

void advance(Simulation& simulation, int periods) {
  for (int i = 0; i < periods; ++i) simulation.advance();
}

std::vector<double> field(const Simulation& simulation, const char* name) {
  std::vector<double> values;
  simulation.particle_field(name, values);
  return values;
}

/// Largest difference of a field, over the largest value that it has.
double difference(const Simulation& a, const Simulation& b, const char* name) {
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
constexpr double kRoundOff = 1e-10;

void expect_alike(Simulation& here, Simulation& there) {
  EXPECT_EQ(here.time(), there.time());
  const mpm::SolverState a = here.state(), b = there.state();
  EXPECT_EQ(a.step.steps, b.step.steps);
  EXPECT_NEAR(a.step.dt_min, b.step.dt_min, kRoundOff * a.step.dt_min);
  EXPECT_EQ(a.step.limited_by.substr(0, 20), b.step.limited_by.substr(0, 20));
  for (const char* energy : {"kinetic", "elastic", "potential", "plastic"}) {
    EXPECT_NEAR(a.energy.of(energy), b.energy.of(energy), kRoundOff * a.energy.whole()) << energy;
  }
  ASSERT_EQ(a.audit.impulses.size(), b.audit.impulses.size());
  for (std::size_t i = 0; i < a.audit.impulses.size(); ++i) {
    EXPECT_EQ(a.audit.impulses[i].name, b.audit.impulses[i].name);
    const double size = a.audit.exchanged;
    EXPECT_NEAR((a.audit.impulses[i].impulse - b.audit.impulses[i].impulse).norm(), 0.0, kRoundOff * size)
        << a.audit.impulses[i].name;
  }
  EXPECT_NEAR(a.audit.exchanged, b.audit.exchanged, kRoundOff * a.audit.exchanged);
  EXPECT_LT(b.audit.residual, kRoundOff);
  for (const char* name : {"x", "z", "vz", "j"}) EXPECT_LT(difference(here, there, name), kRoundOff) << name;
}

/// `energies`: names of some that the scene has beside those of all.
void expect_run_alike(SimulationDefinition (*of)(mpm::Precision), const std::vector<const char*>& energies = {}) {
  Simulation here(scene(of), options(false)), there(scene(of), options(true));
  expect_alike(here, there);
  advance(here, kPeriods);
  advance(there, kPeriods);
  expect_alike(here, there);
  EXPECT_LT(difference(here, there, "szz"), kRoundOff);
  const mpm::EnergyReport a = here.state().energy, b = there.state().energy;
  EXPECT_FALSE(b.closed());
  for (const char* energy : energies) {
    EXPECT_GT(std::abs(a.of(energy)), 1e-6 * a.whole()) << energy;
    EXPECT_NEAR(a.of(energy), b.of(energy), kRoundOff * a.whole()) << energy;
  }
  const std::vector<mpm::NamedNumber> one = here.numbers(), other = there.numbers();
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_NEAR(one[i].value, other[i].value, kRoundOff * std::abs(one[i].value)) << one[i].name;
  }
}

TEST(GpuSimulation, ElasticBlockRunsAsOnTheProcessor) { expect_run_alike(gpu_scenes::falling_block); }
TEST(GpuSimulation, ColumnRunsAsOnTheProcessor) { expect_run_alike(gpu_scenes::column); }

// The particles of a cell that flow share a stress, as soil does without being asked.
SimulationDefinition averaged_column(mpm::Precision precision) {
  SimulationDefinition d = gpu_scenes::column(precision);
  d.method.average_stress = true;
  return d;
}
/// The same in space, of clay: the pressure of J2 follows from J.
SimulationDefinition averaged_clay(mpm::Precision precision) {
  SimulationDefinition d = gpu_scenes::falling_block(precision);
  d.method.average_stress = true;
  mpm::J2PlasticityDefinition law;
  law.elasticity = {1e6, 0.45};
  law.yield_stress = 2e3;
  d.materials.front().law = law;
  return d;
}
void expect_averaged_alike(SimulationDefinition (*of)(mpm::Precision)) {
  expect_run_alike(of);
  Simulation here(scene(of), options(false));
  advance(here, kPeriods);
  const mpm::EnergyReport energy = here.state().energy;
  EXPECT_GT(energy.of("stress averaging"), 1e-6 * energy.of("plastic"));  // there is something to average
}
TEST(GpuSimulation, AveragedColumnRunsAsOnTheProcessor) { expect_averaged_alike(averaged_column); }
TEST(GpuSimulation, AveragedClayRunsAsOnTheProcessor) { expect_averaged_alike(averaged_clay); }

// Strain in halves, as a scene has it without being asked, and with boxes that stretch; splines that reach farther.
SimulationDefinition halved_column(mpm::Precision precision) {
  SimulationDefinition d = averaged_column(precision);
  d.method.update = mpm::UpdateScheme::usavg;
  return d;
}
SimulationDefinition stretching_column(mpm::Precision precision) {
  SimulationDefinition d = halved_column(precision);
  d.method.shape = mpm::ShapeKind::ugimp_stretch;
  return d;
}
SimulationDefinition splines_with_apic(mpm::Precision precision) {
  SimulationDefinition d = gpu_scenes::falling_block(precision);
  d.method.shape = mpm::ShapeKind::bspline3;
  d.method.transfer = {mpm::TransferKind::apic, 0.0, 1};
  return d;
}
TEST(GpuSimulation, StrainInHalvesRunsAsOnTheProcessor) { expect_run_alike(halved_column); }
TEST(GpuSimulation, StretchingBoxesRunAsOnTheProcessor) { expect_run_alike(stretching_column); }
TEST(GpuSimulation, SplinesWithApicRunAsOnTheProcessor) { expect_run_alike(splines_with_apic); }

TEST(GpuSimulation, MixturesRunAsOnTheProcessor) {
  expect_run_alike(gpu_scenes::block_mixture, {"transfer"});
  expect_run_alike(gpu_scenes::column_mixture, {"transfer"});
}
TEST(GpuSimulation, DampingRunsAsOnTheProcessor) {
  expect_run_alike(gpu_scenes::block_damped);
  expect_run_alike(gpu_scenes::column_damped, {"transfer", "damping"});
  expect_run_alike(gpu_scenes::column_damped_fmpm, {"damping"});
}
TEST(GpuSimulation, LoadsRunAsOnTheProcessor) {
  expect_run_alike(gpu_scenes::block_loaded, {"load_work"});
  expect_run_alike(gpu_scenes::column_loaded, {"load_work"});
}
TEST(GpuSimulation, TractionsRunAsOnTheProcessor) {
  expect_run_alike(gpu_scenes::column_traction, {"load_work"});
  expect_run_alike(gpu_scenes::block_traction, {"load_work"});
}
TEST(GpuSimulation, FeedbackGrowsAsOnTheProcessor) {
  Simulation there(scene(gpu_scenes::column_damped), options(true));
  advance(there, kPeriods);
  ASSERT_EQ(there.numbers().front().name, "alpha");
  EXPECT_GT(there.numbers().front().value, 0.1);
}
TEST(GpuSimulation, ParticlesArePutBackAsOnTheProcessor) {
  expect_run_alike(gpu_scenes::blocks_leaving, {"leaving"});
  SimulationDefinition d = scene(gpu_scenes::blocks_leaving);
  d.grid.leave_limit = 2;
  Simulation there(d, options(true));
  try {
    advance(there, kPeriods);
    FAIL() << "no error";
  } catch (const mpm::PhysicsError& error) {
    EXPECT_NE(std::string(error.what()).find("more than 2 particles have left the grid"), std::string::npos)
        << error.what();
  }
}
TEST(GpuSimulation, PrescribedVelocitiesRunAsOnTheProcessor) {
  expect_run_alike(gpu_scenes::block_pulled, {"load_work"});
  expect_run_alike(gpu_scenes::column_pressed, {"load_work"});
  expect_run_alike(gpu_scenes::blocks_held, {"load_work"});
}

// Half of the run on one, half on the other, by a checkpoint; either way. Accounts go on, of walls and of all else, and
// so does what is remembered from step to step.
TEST(GpuSimulation, CheckpointsGoFromOneToTheOther) {
  const mpm::test::Folder folder;
  for (const auto of : {averaged_column, gpu_scenes::column_mixture, gpu_scenes::column_damped,
                        gpu_scenes::block_loaded, gpu_scenes::column_pressed}) {
    Simulation whole(scene(of), options(false));
    advance(whole, kPeriods);
    for (const bool begins_on_device : {true, false}) {
      const std::string file = folder.file(begins_on_device ? "from_device.h5" : "to_device.h5");
      Simulation first(scene(of), options(begins_on_device));
      advance(first, kPeriods / 2);
      mpm::save_checkpoint(file, first, {});
      Simulation second(scene(of), options(!begins_on_device));
      mpm::load_checkpoint(file, second, "");
      EXPECT_EQ(first.state_hash(), second.state_hash());
      advance(second, kPeriods / 2);
      expect_alike(whole, second);
    }
  }
}

// Reading between two sync points changes nothing that follows.
TEST(GpuSimulation, ReadingChangesNothing) {
  Simulation quiet(scene(gpu_scenes::column), options(true)), read(scene(gpu_scenes::column), options(true));
  for (int i = 0; i < kPeriods; ++i) {
    quiet.advance();
    read.advance();
    field(read, "szz");
    read.memory_hash();
  }
  EXPECT_EQ(quiet.state_hash(), read.state_hash());
}

// A particle that leaves the domain ends the run by a PhysicsError that names it, and the run does not go on.
TEST(GpuSimulation, FailsAsARunDoes) {
  SimulationDefinition d = scene(gpu_scenes::falling_block);
  for (mpm::WallDefinition& wall : d.walls) wall.kind = mpm::WallKind::none;
  Simulation simulation(d, options(true));
  try {
    advance(simulation, 200);
    FAIL() << "no error";
  } catch (const mpm::PhysicsError& error) {
    EXPECT_NE(std::string(error.what()).find("particle "), std::string::npos) << error.what();
  }
  EXPECT_THROW(simulation.advance(), mpm::PhysicsError);
  const std::vector<double> z = field(simulation, "z");
  const auto falls = [](double height) { return height < 0.0; };
  EXPECT_TRUE(std::any_of(z.begin(), z.end(), falls));  // the state of the failed step can be read
}

TEST(GpuSimulation, RefusesModulesOfTheProgram) {
  SimulationOptions both = options(true);
  both.modules.push_back([](mpm::RunParts&) {});
  EXPECT_THROW(Simulation(scene(gpu_scenes::column), both), mpm::DefinitionError);
}

void expect_refused(const SimulationDefinition& d, const std::string& what) {
  try {
    Simulation simulation(d, options(true));
    FAIL() << "no error";
  } catch (const mpm::DefinitionError& error) {
    EXPECT_EQ(error.what(), "gpu: " + what + " does not run there: run the scene on the processor");
  }
}
TEST(GpuSimulation, RefusesByName) {
  SimulationDefinition d = scene(gpu_scenes::column);
  mpm::NewtonianFluidDefinition water;
  water.bulk_modulus = 2e6;
  water.viscosity = 1e-3;
  d.materials.front().law = water;
  expect_refused(d, "a liquid, whose volume is corrected,");
  d = scene(gpu_scenes::column);
  d.walls[4].kind = mpm::WallKind::frictional;
  d.walls[4].friction.coefficient = 0.3;
  expect_refused(d, "a frictional wall in a run");
}

}  // namespace gpu_simulation_test
