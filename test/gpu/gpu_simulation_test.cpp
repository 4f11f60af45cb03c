// A whole simulation whose steps a device takes: its clock, step limits, accounts, fields and checkpoints are those of
// a run on the processor. Cost: 10 s.
#include "gpu_runs.hpp"

namespace gpu_simulation_test {

using namespace gpu_runs;

/// `energies`: names of some that the scene has beside those of all.
void expect_run_alike(SimulationDefinition (*of)(mpm::Precision), const std::vector<const char*>& energies = {}) {
  Simulation here(scene(of), options(false)), there(scene(of), options(true));
  expect_alike(here, there);
  advance(here, kPeriods);
  advance(there, kPeriods);
  expect_alike(here, there);
  EXPECT_LT(difference(here, there, "szz"), kRoundOff);
  const mpm::EnergyReport a = here.state().energy;
  for (const char* energy : energies) EXPECT_GT(std::abs(a.of(energy)), 1e-6 * a.whole()) << energy;
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

// Places and velocities are brought to the host without the rest, which comes when it is asked for.
TEST(GpuSimulation, ReadsInParts) {
  Simulation whole(scene(averaged_column), options(true)), parts(scene(averaged_column), options(true));
  advance(whole, 4);
  advance(parts, 3);
  field(parts, "vz");
  field(parts, "ep");
  parts.advance();
  for (const char* name : {"z", "ep", "szz", "vx", "strain_energy"})
    EXPECT_EQ(field(parts, name), field(whole, name)) << name;
  EXPECT_EQ(parts.state_hash(), whole.state_hash());
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
  Simulation here(d, options(false));
  EXPECT_THROW(advance(here, 200), mpm::PhysicsError);
  EXPECT_EQ(simulation.time(), here.time());  // that of the sync point before, wherever in its period the step failed
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
    EXPECT_EQ(std::string(error.what()).find("--device: steps on a graphics processor and " + what), 0U)
        << error.what();
  }
}
TEST(GpuSimulation, RefusesByName) {
  SimulationDefinition d = scene(gpu_scenes::column);
  d.method.average_dilatation = true;
  expect_refused(d, "averaged dilatation do not go together: ");
}

}  // namespace gpu_simulation_test
