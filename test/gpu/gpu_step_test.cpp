// Steps made of kernels of an index: they agree with the solver over 100 steps, have the same bits in whatever order
// indices are visited, and every impulse is found. Cost: 15 s.
#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "gpu_method_scenes.hpp"

namespace gpu_step_test {

using mpm::ParticleSet;
using mpm::SimulationDefinition;
using mpm_gpu::DeviceRun;
using mpm_gpu::Executor;
using mpm_gpu::Visits;
using SceneOf = SimulationDefinition (*)(mpm::Precision);

constexpr int kSteps = 100;

/// The largest differences of particles, by id, and of the whole momentum.
struct Difference {
  double place = 0.0;     ///< [m]
  double velocity = 0.0;  ///< [m/s]
  double momentum = 0.0;  ///< [N s]
};

Difference difference(const std::vector<ParticleSet>& a, const std::vector<ParticleSet>& b) {
  Difference most;
  double sum[3] = {};
  for (std::size_t s = 0; s < a.size(); ++s) {
    std::map<std::uint32_t, int> place;
    for (int p = 0; p < b[s].size(); ++p) place[b[s].id[p]] = p;
    for (int p = 0; p < a[s].size(); ++p) {
      const int q = place.at(a[s].id[p]);
      for (std::size_t k = 0; k < a[s].x.size(); ++k) {
        const double dv = a[s].v[k][p] - b[s].v[k][q];
        most.place = std::max(most.place, std::abs(a[s].x[k][p] - b[s].x[k][q]));
        most.velocity = std::max(most.velocity, std::abs(dv));
        sum[k] += a[s].mass * dv;
      }
    }
  }
  most.momentum = std::hypot(sum[0], sum[1], sum[2]);
  return most;
}

double total_mass(const std::vector<ParticleSet>& sets) {
  double mass = 0.0;
  for (const ParticleSet& set : sets) mass += set.total_mass();
  return mass;
}

double norm(const double* v) { return std::hypot(v[0], v[1], v[2]); }

double most_of(const mpm::ParticleScalar& scalar) {
  double most = 0.0;
  for (std::size_t p = 0; p < scalar.size(); ++p) most = std::max(most, scalar[p]);
  return most;
}

/// Momentum exchanged with walls and by gravity [N s].
double exchanged(const mpm_gpu::Impulses& impulses) { return norm(impulses.walls().data()) + norm(impulses.gravity); }

template <class T>
constexpr mpm::Precision kPrecision = sizeof(T) == 8 ? mpm::Precision::float64 : mpm::Precision::float32;

// Agreement to `bound` times the momentum exchanged, for all particles together; for each particle to the way at the
// speed that this gives to all the mass and, in double, to that speed. In single precision round-off of stiff stresses
// is larger for a particle's velocity: the solver's own, against its run in double, is the bound.
template <class T>
void expect_agreement(SceneOf scene, double bound) {
  const SimulationDefinition d = scene(kPrecision<T>);
  const double dt = gpu_scenes::step_of(d);
  mpm::SimulationProbe solver(d);
  const mpm::RunModules modules = solver.modules();  // tractions are those of a simulation
  DeviceRun<T> run(d, solver.sets(), Executor(), d.tractions.empty() ? nullptr : &modules);
  for (int i = 0; i < kSteps; ++i) {
    const double start = solver.time();
    solver.step(dt);
    run.solver().step(dt, start);
  }
  std::vector<ParticleSet> sets = solver.sets();
  run.write_to(sets);
  const Difference found = difference(solver.sets(), sets);
  const double impulse = exchanged(run.solver().impulses()), speed = impulse / total_mass(sets);
  EXPECT_GT(speed, 0.0);
  EXPECT_LT(found.momentum, bound * impulse);
  EXPECT_LT(found.place, bound * speed * kSteps * dt);
  EXPECT_GT(run.solver().sorts(), 1);  // particles have changed cells
  if (sizeof(T) == 8) {
    EXPECT_LT(found.velocity, bound * speed);
  } else {
    mpm::SimulationProbe exact(scene(mpm::Precision::float64));
    for (int i = 0; i < kSteps; ++i) exact.step(dt);
    EXPECT_LT(found.velocity, 2.0 * difference(exact.sets(), solver.sets()).velocity);
  }
  for (const ParticleSet& set : sets) {
    for (const mpm::ParticleScalar& history : set.history) EXPECT_GT(most_of(history), 0.0);  // it has yielded
  }
}

TEST(GpuStep, ElasticBlockAgreesInDouble) { expect_agreement<double>(gpu_scenes::falling_block, 1e-10); }
TEST(GpuStep, ElasticBlockAgreesInSingle) { expect_agreement<float>(gpu_scenes::falling_block, 1e-5); }
TEST(GpuStep, ColumnAgreesInDouble) { expect_agreement<double>(gpu_scenes::column, 1e-10); }
TEST(GpuStep, ColumnAgreesInSingle) { expect_agreement<float>(gpu_scenes::column, 1e-5); }
TEST(GpuStep, MetalAgreesInDouble) { expect_agreement<double>(gpu_scenes::metal, 1e-10); }
TEST(GpuStep, MetalAgreesInSingle) { expect_agreement<float>(gpu_scenes::metal, 1e-5); }
TEST(GpuStep, TwoBodiesAgreeInDouble) { expect_agreement<double>(gpu_scenes::two_blocks, 1e-10); }
TEST(GpuStep, TwoBodiesAgreeInSingle) { expect_agreement<float>(gpu_scenes::two_blocks, 1e-5); }
TEST(GpuStep, LiquidsAgreeInDouble) { expect_agreement<double>(gpu_scenes::dam_in_plane, 1e-10); }
TEST(GpuStep, LiquidsAgreeInSingle) { expect_agreement<float>(gpu_scenes::dam_in_plane, 1e-5); }
TEST(GpuStep, StrainLastAgreesInDouble) { expect_agreement<double>(gpu_scenes::block_usl, 1e-10); }
TEST(GpuStep, StrainLastAgreesInSingle) { expect_agreement<float>(gpu_scenes::block_usl, 1e-5); }
TEST(GpuStep, StrainInHalvesAgreesInDouble) { expect_agreement<double>(gpu_scenes::column_usavg, 1e-10); }
TEST(GpuStep, StrainInHalvesAgreesInSingle) { expect_agreement<float>(gpu_scenes::column_usavg, 1e-5); }
TEST(GpuStep, CubicSplinesAgreeInDouble) {
  expect_agreement<double>(gpu_scenes::metal_cubic, 1e-10);
  expect_agreement<double>(gpu_scenes::column_cubic, 1e-10);
}
TEST(GpuStep, CubicSplinesAgreeInSingle) { expect_agreement<float>(gpu_scenes::column_cubic, 1e-5); }
TEST(GpuStep, StretchingBoxesAgreeInDouble) { expect_agreement<double>(gpu_scenes::column_stretch, 1e-10); }
TEST(GpuStep, StretchingBoxesAgreeInSingle) { expect_agreement<float>(gpu_scenes::column_stretch, 1e-5); }
TEST(GpuStep, AffineTransferAgreesInDouble) {
  expect_agreement<double>(gpu_scenes::block_apic, 1e-10);
  expect_agreement<double>(gpu_scenes::column_apic, 1e-10);
}
TEST(GpuStep, AffineTransferAgreesInSingle) { expect_agreement<float>(gpu_scenes::column_apic, 1e-5); }
TEST(GpuStep, IncrementsAgreeInDouble) {
  expect_agreement<double>(gpu_scenes::blocks_xpic, 1e-10);
  expect_agreement<double>(gpu_scenes::column_fmpm, 1e-10);
}
TEST(GpuStep, IncrementsAgreeInSingle) {
  expect_agreement<float>(gpu_scenes::blocks_xpic, 1e-5);
  expect_agreement<float>(gpu_scenes::column_fmpm, 1e-5);
}
TEST(GpuStep, FrictionAgreesInDouble) {
  expect_agreement<double>(gpu_scenes::block_friction, 1e-10);
  expect_agreement<double>(gpu_scenes::column_friction, 1e-10);
}
TEST(GpuStep, FrictionAgreesInSingle) { expect_agreement<float>(gpu_scenes::block_friction, 1e-5); }
TEST(GpuStep, MixturesAgreeInDouble) {
  expect_agreement<double>(gpu_scenes::column_mixture, 1e-10);
  expect_agreement<double>(gpu_scenes::block_mixture, 1e-10);
}
TEST(GpuStep, MixturesAgreeInSingle) { expect_agreement<float>(gpu_scenes::column_mixture, 1e-5); }
TEST(GpuStep, DampingAgreesInDouble) {
  expect_agreement<double>(gpu_scenes::block_damped, 1e-10);
  expect_agreement<double>(gpu_scenes::column_damped, 1e-10);
  expect_agreement<double>(gpu_scenes::column_damped_fmpm, 1e-10);
}
TEST(GpuStep, DampingAgreesInSingle) {
  expect_agreement<float>(gpu_scenes::block_damped, 1e-5);
  expect_agreement<float>(gpu_scenes::column_damped, 1e-5);
}
TEST(GpuStep, LoadsAgreeInDouble) {
  expect_agreement<double>(gpu_scenes::block_loaded, 1e-10);
  expect_agreement<double>(gpu_scenes::column_loaded, 1e-10);
}
TEST(GpuStep, TractionsAgreeInDouble) {
  expect_agreement<double>(gpu_scenes::column_traction, 1e-10);
  expect_agreement<double>(gpu_scenes::block_traction, 1e-10);
}
TEST(GpuStep, TractionsAgreeInSingle) { expect_agreement<float>(gpu_scenes::column_traction, 1e-5); }
TEST(GpuStep, LoadsAgreeInSingle) { expect_agreement<float>(gpu_scenes::block_loaded, 1e-5); }
TEST(GpuStep, PrescribedVelocitiesAgreeInDouble) {
  expect_agreement<double>(gpu_scenes::block_pulled, 1e-10);
  expect_agreement<double>(gpu_scenes::column_pressed, 1e-10);
  expect_agreement<double>(gpu_scenes::blocks_held, 1e-10);
}
TEST(GpuStep, PrescribedVelocitiesAgreeInSingle) { expect_agreement<float>(gpu_scenes::block_pulled, 1e-5); }
TEST(GpuStep, ParticlesPutBackAgreeInDouble) { expect_agreement<double>(gpu_scenes::blocks_leaving, 1e-10); }
TEST(GpuStep, ParticlesPutBackAgreeInSingle) { expect_agreement<float>(gpu_scenes::blocks_leaving, 1e-5); }

// Each update with each shape function and transfer: 48 runs of a little column, between a wall that it sticks to and a
// floor that it slides on.
TEST(GpuStep, PairsOfMethodsAgree) {
  constexpr int kFew = 25;
  for (const auto update : {mpm::UpdateScheme::usf, mpm::UpdateScheme::usl, mpm::UpdateScheme::usavg}) {
    for (const auto shape :
         {mpm::ShapeKind::ugimp, mpm::ShapeKind::ugimp_stretch, mpm::ShapeKind::bspline2, mpm::ShapeKind::bspline3}) {
      for (const auto transfer :
           {mpm::TransferKind::flip, mpm::TransferKind::xpic, mpm::TransferKind::fmpm, mpm::TransferKind::apic}) {
        SimulationDefinition d = gpu_scenes::column_friction(mpm::Precision::float64);
        d.bodies = {gpu_scenes::block(d, "sand", {0.0, 0.0, 0.0}, {3.0, 0.0, 4.0}, {1.0, 0.0, -0.5})};
        d.method.update = update;
        d.method.shape = shape;
        d.method.transfer.kind = transfer;
        SCOPED_TRACE(std::string(mpm::kUpdateNames[static_cast<int>(update)]) + " " + mpm::shape_name(shape) + " " +
                     mpm::kTransferNames[static_cast<int>(transfer)]);
        const double dt = gpu_scenes::step_of(d);
        mpm::SimulationProbe solver(d);
        DeviceRun<double> run(d, solver.sets());
        for (int i = 0; i < kFew; ++i) {
          solver.step(dt);
          run.solver().step(dt);
        }
        std::vector<ParticleSet> sets = solver.sets();
        run.write_to(sets);
        const Difference found = difference(solver.sets(), sets);
        const double impulse = exchanged(run.solver().impulses());
        EXPECT_GT(impulse, 0.0);
        EXPECT_LT(found.momentum, 1e-10 * impulse);
        EXPECT_LT(found.velocity, 1e-10 * impulse / total_mass(sets));
      }
    }
  }
}

// The change of momentum is the sum of the impulses of gravity and walls, each found by itself.
template <class T>
void expect_closed(SceneOf scene, double bound) {
  const SimulationDefinition d = scene(kPrecision<T>);
  const double dt = gpu_scenes::step_of(d);
  mpm::SimulationProbe solver(d);
  DeviceRun<T> run(d, solver.sets());
  const auto before = run.solver().momentum();
  for (int i = 0; i < kSteps; ++i) run.solver().step(dt);
  const auto after = run.solver().momentum();
  const mpm_gpu::Impulses& all = run.solver().impulses();
  double rest[3] = {};
  for (int k = 0; k < 3; ++k) rest[k] = after[k] - before[k] - all.walls()[k] - all.gravity[k];
  EXPECT_GT(norm(all.walls().data()), 0.1 * norm(all.gravity));  // the wall is met
  EXPECT_LT(norm(rest), bound * exchanged(all));
}

TEST(GpuStep, MomentumCloses) {
  expect_closed<double>(gpu_scenes::falling_block, 1e-10);
  expect_closed<double>(gpu_scenes::column, 1e-10);
  expect_closed<double>(gpu_scenes::metal, 1e-10);
  expect_closed<float>(gpu_scenes::metal, 1e-5);
  expect_closed<double>(gpu_scenes::column_usavg, 1e-10);
  expect_closed<double>(gpu_scenes::column_cubic, 1e-10);
  expect_closed<double>(gpu_scenes::column_apic, 1e-10);
  expect_closed<double>(gpu_scenes::column_fmpm, 1e-10);
  expect_closed<double>(gpu_scenes::column_friction, 1e-10);
}

/// All numbers of a run after some steps.
template <class T>
std::vector<unsigned char> bytes_after(SceneOf scene, Executor executor, int steps) {
  const SimulationDefinition d = scene(kPrecision<T>);
  mpm::SimulationProbe solver(d);
  DeviceRun<T> run(d, solver.sets(), executor);
  const double dt = gpu_scenes::step_of(d);
  for (int i = 0; i < steps; ++i) run.solver().step(dt);
  return gpu_scenes::bytes_of(run);
}

template <class T>
void expect_same_bits(SceneOf scene) {
  constexpr int kFew = 60;  // in which particles change cells
  const auto forwards = bytes_after<T>(scene, Executor(Visits::forwards, 1), kFew);
  EXPECT_EQ(forwards, bytes_after<T>(scene, Executor(Visits::backwards, 1), kFew));
  EXPECT_EQ(forwards, bytes_after<T>(scene, Executor(Visits::shuffled, 1), kFew));
  EXPECT_EQ(forwards, bytes_after<T>(scene, Executor(Visits::shuffled, 3), kFew));
  EXPECT_NE(forwards, bytes_after<T>(scene, Executor(Visits::forwards, 1), kFew - 1));
}

TEST(GpuStep, OrderOfVisitsDoesNotMatter) {
  expect_same_bits<double>(gpu_scenes::falling_block);
  expect_same_bits<float>(gpu_scenes::column);
  expect_same_bits<double>(gpu_scenes::two_blocks);
  expect_same_bits<float>(gpu_scenes::column_cubic);
  expect_same_bits<double>(gpu_scenes::column_apic);
  expect_same_bits<float>(gpu_scenes::column_friction);
  expect_same_bits<double>(gpu_scenes::column_mixture);
  expect_same_bits<double>(gpu_scenes::column_damped);
  expect_same_bits<float>(gpu_scenes::block_loaded);
  expect_same_bits<double>(gpu_scenes::column_pressed);
}

// Half of the steps here, the rest by the solver from what was written back.
TEST(GpuStep, SolverGoesOnFromThere) {
  const SimulationDefinition d = gpu_scenes::falling_block(mpm::Precision::float64);
  const double dt = gpu_scenes::step_of(d);
  mpm::SimulationProbe whole(d), handed(d);
  DeviceRun<double> run(d, handed.sets());
  for (int i = 0; i < kSteps / 2; ++i) run.solver().step(dt);
  run.write_to(handed.sets());
  handed.sort();
  for (int i = 0; i < kSteps / 2; ++i) handed.step(dt);
  for (int i = 0; i < kSteps; ++i) whole.step(dt);
  const Difference found = difference(whole.sets(), handed.sets());
  const double impulse = exchanged(run.solver().impulses());
  EXPECT_LT(found.momentum, 1e-10 * impulse);
  EXPECT_LT(found.velocity, 1e-10 * impulse / total_mass(whole.sets()));
}

TEST(GpuStep, RefusesByName) {
  SimulationDefinition d = gpu_scenes::falling_block(mpm::Precision::float64);
  EXPECT_EQ(mpm_gpu::refused(d), "");
  const std::string begin = "steps on a graphics processor and ";
  d = gpu_scenes::column(mpm::Precision::float64);
  d.walls[0].kind = mpm::WallKind::absorbing;
  EXPECT_EQ(mpm_gpu::refused(d).find(begin + "absorbing faces (x_min) "), 0U) << mpm_gpu::refused(d);
  d = gpu_scenes::block_damped(mpm::Precision::float64);
  d.method.damping.grid = mpm::Function::parse("10 * x");
  EXPECT_EQ(mpm_gpu::refused(d).find(begin + "damping that depends on the place "), 0U) << mpm_gpu::refused(d);
  d = gpu_scenes::block_loaded(mpm::Precision::float64);
  EXPECT_EQ(mpm_gpu::refused(d), "");
  for (const char* load : {"x", "X + z", "t * X"}) {
    d.body_forces[0].acceleration[2] = mpm::Function::parse(load, {}, mpm::FunctionPlaces::present_and_start);
    EXPECT_EQ(mpm_gpu::refused(d).find(begin + "loads that depend on the present place"), 0U) << load;
  }
  d = gpu_scenes::block_traction(mpm::Precision::float64);
  EXPECT_EQ(mpm_gpu::refused(d), "");
  d.tractions[0].follows = true;
  EXPECT_EQ(mpm_gpu::refused(d).find(begin + "tractions that follow a face"), 0U) << mpm_gpu::refused(d);
  d = gpu_scenes::column_pressed(mpm::Precision::float64);
  EXPECT_EQ(mpm_gpu::refused(d), "");
  d.method.update = mpm::UpdateScheme::implicit;
  EXPECT_EQ(mpm_gpu::refused(d).find(begin + "velocity conditions beside"), 0U) << mpm_gpu::refused(d);
  d.method.update = mpm::UpdateScheme::usavg;
  d.walls[0].kind = mpm::WallKind::frictional;
  EXPECT_EQ(mpm_gpu::refused(d).find(begin + "velocity conditions beside"), 0U) << mpm_gpu::refused(d);
  const std::vector<ParticleSet> none;
  EXPECT_THROW(DeviceRun<double>(d, none), mpm_gpu::GpuError);
  // Steps alone have no solve of an implicit step.
  d = gpu_scenes::column(mpm::Precision::float64);
  mpm::SimulationProbe solver(d);
  d.method.update = mpm::UpdateScheme::implicit;
  EXPECT_THROW(DeviceRun<double>(d, solver.sets()), mpm_gpu::GpuError);
}

// A step so long that the block leaves the domain names one of its particles.
TEST(GpuStep, FailsByName) {
  const SimulationDefinition d = gpu_scenes::falling_block(mpm::Precision::float64);
  mpm::SimulationProbe solver(d);
  DeviceRun<double> run(d, solver.sets());
  try {
    run.solver().step(10.0);
    run.solver().look();
    FAIL() << "no error";
  } catch (const mpm_gpu::GpuError& error) {
    EXPECT_NE(std::string(error.what()).find("gpu: particle "), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("shorten the time step"), std::string::npos) << error.what();
  }
}

}  // namespace gpu_step_test
