// A run whose steps become too long on the way, and one that makes energy. About 1 s.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm/modules/run_parts.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace run_safety_test {

constexpr double kCell = 0.05;  // [m]

SimulationDefinition block(double young) {
  SimulationDefinition d;
  d.geometry = GeometryKind::plane_strain;
  d.grid = {Vec3::Constant(kCell), Vec3::Zero(), Vec3::Constant(1.0)};
  d.materials = {{"m", 1000.0, NeoHookeanDefinition{{young, 0.3}}}};
  DeformableBody body;
  body.name = "block";
  body.material = "m";
  body.particle_volume = 0.25 * kCell * kCell;
  for (double x = 0.2 + 0.25 * kCell; x < 0.8; x += 0.5 * kCell) {
    for (double z = 0.25 * kCell; z < 0.4; z += 0.5 * kCell) body.positions.emplace_back(x, 0.0, z);
  }
  d.bodies = {body};
  return d;
}

/// The block is pressed to a third of its height within one sync period, in which it gets several times as stiff: waves
/// at the end are far faster than when the period's steps were chosen.
SimulationDefinition press(std::int64_t sync) {
  SimulationDefinition d = block(2e4);
  d.time.sync = sync;
  d.time.cfl = 0.8;
  d.gravity = {0.0, 0.0, -9.81};
  for (WallDefinition& wall : d.walls) wall.kind = WallKind::slip;
  RigidBodyDefinition plate;
  plate.name = "plate";
  plate.surface = make_box({1.0, 2.0, 0.2});
  plate.pose.position = {0.5, 0.0, 0.5};
  plate.velocity = {0.0, 0.0, -1.0};
  d.rigid_bodies = {plate};
  return d;
}

TEST(LongSteps, AreMadeShorterOnTheWay) {
  constexpr std::int64_t kEnd = 260'000'000;  // [ns]
  Simulation simulation(press(kEnd), {1}), two_threads(press(kEnd), {2});
  simulation.advance();
  two_threads.advance();
  const StepReport steps = simulation.state().step;
  EXPECT_EQ(steps.divided, 1u);   // the only period
  EXPECT_LE(steps.courant, 1.0);  // no wave outran a cell
  EXPECT_GE(steps.courant, 0.8);
  EXPECT_LT(steps.dt_min, 0.8 * steps.dt_max);
  EXPECT_EQ(simulation.time(), kEnd);
  EXPECT_EQ(simulation.state_hash(), two_threads.state_hash());
  // The steps of different length add up to the period: so say the plate's way and the weight's impulse.
  EXPECT_NEAR(simulation.bodies()[0].pose.position.z(), 0.5 - 0.26, 1e-14);
  const AuditReport audit = simulation.state().audit;
  EXPECT_NEAR(audit.impulses[0].impulse.z(), -9.81 * 1000.0 * (0.6 * 0.4) * 0.26, 1e-10);
  EXPECT_LT(audit.residual, 1e-12);
}

// Stores in a checkpoint what was seen, divided and looked at: a run that goes on from one remembers the same to the
// bit.
TEST(LongSteps, AreRememberedInCheckpoints) {
  const auto path = std::filesystem::temp_directory_path() / fmt::format("mpm_run_safety_{}.h5", getpid());
  Simulation whole(press(130'000'000), {1}), again(press(130'000'000), {1});
  whole.advance();
  whole.advance();
  ASSERT_GE(whole.state().step.divided, 1u);
  save_checkpoint(path.string(), whole, {"press.yaml", "press", {}});
  load_checkpoint(path.string(), again, "press");
  std::filesystem::remove(path);
  EXPECT_EQ(again.state().step.divided, whole.state().step.divided);
  EXPECT_EQ(again.state().step.courant, whole.state().step.courant);
  EXPECT_EQ(again.memory_hash(), whole.memory_hash());
  whole.advance();
  again.advance();
  EXPECT_EQ(again.memory_hash(), whole.memory_hash());
}

TEST(LongSteps, LeaveASteadyRunAsItIs) {
  SimulationDefinition d = block(1e6);
  for (WallDefinition& wall : d.walls) wall.kind = WallKind::slip;
  d.gravity = {0.0, 0.0, -9.81};
  d.time.sync = 50'000'000;
  Simulation simulation(d, {1});
  simulation.advance();
  const StepReport steps = simulation.state().step;
  EXPECT_GT(steps.steps, 16u);
  EXPECT_EQ(steps.divided, 0u);
  EXPECT_EQ(steps.dt_min, steps.dt_max);
  EXPECT_LT(steps.courant, std::sqrt(d.time.cfl));
}

/// Makes all particles faster by a constant part in every step, and says so or not.
class Pump final : public Module {
 public:
  Pump(RunParts& parts, double rate, bool says_so) : set_(parts.sets[0]), rate_(rate), says_so_(says_so) {}
  std::string name() const override { return "pump"; }
  bool needs_sort() const override { return true; }
  void before_sort() override {
    double kinetic = 0.0;
    for (ParticleScalar& v : set_.v) {
      for (int p = 0; p < set_.size(); ++p) {
        kinetic += 0.5 * set_.mass_of(p) * v[p] * v[p];
        v.set(p, (1.0 + rate_) * v[p]);
      }
    }
    work_ += (std::pow(1.0 + rate_, 2) - 1.0) * kinetic;
  }
  void energies(EnergyReport& report) const override {
    if (says_so_) report.add("pump", NamedEnergy::Kind::work, work_);
  }

 private:
  ParticleSet& set_;
  double rate_, work_ = 0.0;
  bool says_so_;
};

constexpr double kStartEnergy = 0.5 * 1000.0 * (0.6 * 0.4) * 0.02 * 0.02;  // [J] of the block per metre at 0.02 m/s

Simulation pumped(bool says_so) {
  SimulationDefinition d = block(1e6);
  d.time.sync = 1'000'000;
  d.bodies[0].velocities.assign(d.bodies[0].positions.size(), Vec3(0.0, 0.0, 0.02));
  SimulationOptions options;
  options.threads = 1;
  options.modules = {[says_so](RunParts& parts) { parts.modules.add(std::make_unique<Pump>(parts, 3e-4, says_so)); }};
  return Simulation(d, options);
}

TEST(MadeEnergy, EndsARunWhenItExceedsAllThatWasGiven) {
  Simulation simulation = pumped(false);
  std::string text;
  try {
    for (int i = 0; i < 3000; ++i) simulation.advance();
  } catch (const PhysicsError& error) {
    text = error.what();
  }
  EXPECT_NE(text.find("the run makes energy"), std::string::npos) << text;
  // Made > given = the start's: kinetic energy has doubled. It grows by 13 % between two looks, 200 steps apart.
  const double kinetic = simulation.state().energy.of("kinetic");
  EXPECT_GE(kinetic, 2.0 * kStartEnergy);
  EXPECT_LE(kinetic, 2.0 * kStartEnergy * 1.13 * 1.05);
}

TEST(MadeEnergy, IsNotWhatAModuleGivesAndSaysSo) {
  Simulation simulation = pumped(true);
  // Well above the 2.26 at which a run ends that does not say so.
  while (simulation.state().energy.of("kinetic") < 3.0 * kStartEnergy) ASSERT_NO_THROW(simulation.advance());
}

}  // namespace run_safety_test
}  // namespace mpm
