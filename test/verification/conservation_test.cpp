// Properties that hold to round-off in any run: free fall, momentum audit, the same bits for any number of threads.
#include <gtest/gtest.h>

#include "mpm/simulation/simulation.hpp"
#include "particle_block.hpp"

namespace conservation_test {

using mpm::Vec3;

// A block of `cells` cells along each edge at (0.5, 0.5, 0.5) in a domain of 4 m, cell 0.1 m.
mpm::SimulationDefinition block(mpm::GeometryKind geometry, int cells, const mpm::LawDefinition& law) {
  mpm::SimulationDefinition d;
  d.geometry = geometry;
  const double h = 0.1;
  d.grid = {Vec3::Constant(h), Vec3::Zero(), Vec3::Constant(4.0)};
  d.time.sync = 10'000'000;
  d.materials = {{"m", 1000.0, law}};
  mpm::DeformableBody body;
  body.name = "block";
  body.material = "m";
  const bool solid = geometry == mpm::GeometryKind::solid;
  body.particle_volume = solid ? h * h * h / 8.0 : h * h / 4.0;
  body.positions = particle_block(geometry, Vec3::Constant(0.5), {2 * cells, 2 * cells, 2 * cells}, h / 2);
  d.bodies = {body};
  return d;
}

class EveryMethod : public testing::TestWithParam<std::tuple<mpm::GeometryKind, mpm::UpdateScheme>> {
 protected:
  mpm::SimulationDefinition definition(const mpm::LawDefinition& law, int cells = 5) {
    mpm::SimulationDefinition d = block(std::get<0>(GetParam()), cells, law);
    d.method.update = std::get<1>(GetParam());
    return d;
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod,
                         testing::Combine(testing::Values(mpm::GeometryKind::plane_strain, mpm::GeometryKind::solid),
                                          testing::Values(mpm::UpdateScheme::usf, mpm::UpdateScheme::usavg)));

// x = x0 + v0 t + g t^2 / 2 to round-off: the position update carries the second-order term.
TEST_P(EveryMethod, FreeFallIsExact) {
  auto d = definition(mpm::NeoHookeanDefinition{{1e6, 0.3}});
  d.gravity = {1.0, 0.0, -2.0};
  const Vec3 v0(0.5, 0.0, 3.0);
  d.bodies[0].velocities.assign(d.bodies[0].positions.size(), v0);
  const std::vector<Vec3> start = d.bodies[0].positions;
  mpm::Simulation simulation(d, {1});
  for (int i = 0; i < 50; ++i) simulation.advance();
  const double t = 0.5;
  std::vector<double> x, z, vz, j;
  simulation.particle_field("x", x);
  simulation.particle_field("z", z);
  simulation.particle_field("vz", vz);
  simulation.particle_field("j", j);
  double worst = 0.0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    worst = std::max(worst, std::abs(x[p] - (start[p].x() + v0.x() * t + 0.5 * 1.0 * t * t)));
    worst = std::max(worst, std::abs(z[p] - (start[p].z() + v0.z() * t - 0.5 * 2.0 * t * t)));
    worst = std::max(worst, std::abs(vz[p] - (v0.z() - 2.0 * t)));
    worst = std::max(worst, std::abs(j[p] - 1.0));
  }
  // Some hundred steps of round-off in positions of order 1 m.
  EXPECT_LT(worst, 1e-12);
  EXPECT_LT(simulation.state().audit.residual, 1e-10);
}

TEST_P(EveryMethod, AuditClosesWithWallsGravityDampingAndPic) {
  auto d = definition(mpm::DruckerPragerDefinition{{1e5, 0.3}, 0.6, 0.1, 50.0});
  d.gravity = {0.0, 0.0, -9.81};
  d.method.damping = 3.0;
  d.method.transfer.flip = 0.99;
  d.walls[4] = {mpm::WallKind::frictional, {0.4, false}};
  for (const int face : {0, 2, 3}) d.walls[face] = {mpm::WallKind::slip, {}};
  d.bodies[0].velocities.assign(d.bodies[0].positions.size(), Vec3(-4.0, 0.0, -4.0));
  mpm::Simulation simulation(d, {1});
  for (int i = 0; i < 40; ++i) simulation.advance();
  const mpm::SolverState state = simulation.state();
  double wall_x = 0.0, wall_z = 0.0, damping = 0.0;
  for (const mpm::NamedImpulse& impulse : state.audit.impulses) {
    if (impulse.name == "wall/x_min") wall_x = impulse.impulse.x();
    if (impulse.name == "wall/z_min") wall_z = impulse.impulse.z();
    if (impulse.name == "damping") damping = impulse.impulse.norm();
  }
  // The block hit both walls and damping acted, so the audit is not trivial.
  EXPECT_GT(wall_x, 0.0);
  EXPECT_GT(wall_z, 0.0);
  EXPECT_GT(damping, 0.0);
  EXPECT_LT(state.audit.residual, 1e-10);
}

TEST_P(EveryMethod, SameBitsForAnyNumberOfThreadsAndEveryRun) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 2, 3}) {
    auto d = definition(mpm::DruckerPragerDefinition{{1e5, 0.3}, 0.6, 0.1, 50.0}, 8);
    d.gravity = {0.0, 0.0, -9.81};
    d.walls[4] = {mpm::WallKind::frictional, {0.4, false}};
    d.bodies[0].velocities.assign(d.bodies[0].positions.size(), Vec3(1.0, 0.3, -3.0));
    mpm::Simulation simulation(d, {threads});
    for (int i = 0; i < 20; ++i) simulation.advance();
    hashes.push_back(simulation.state_hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[1], hashes[2]);
  EXPECT_EQ(hashes[0], hashes[3]);
}

// Grid damping: momentum of rigid translation decays as exp(-alpha t) (method reference 6.5), exactly (1 - alpha dt)^n.
TEST_P(EveryMethod, GridDampingSlowsRigidTranslation) {
  auto d = definition(mpm::NeoHookeanDefinition{{1e6, 0.3}});
  d.method.damping = 2.0;
  d.bodies[0].velocities.assign(d.bodies[0].positions.size(), Vec3(1.0, 0.0, 0.0));
  mpm::Simulation simulation(d, {1});
  const double before = simulation.state().audit.momentum.x();
  for (int i = 0; i < 10; ++i) simulation.advance();
  const mpm::SolverState state = simulation.state();
  const double ratio = state.audit.momentum.x() / before;
  EXPECT_NEAR(ratio, std::pow(1.0 - 2.0 * state.step.dt_last, static_cast<double>(state.step.steps)), 1e-6);
  EXPECT_NEAR(ratio, std::exp(-0.2), 1e-3);
}

TEST(Failure, NamesTheParticleTheStepAndTheRemedy) {
  auto d = block(mpm::GeometryKind::solid, 4, mpm::NeoHookeanDefinition{{1e4, 0.3}});
  d.bodies[0].velocities.assign(d.bodies[0].positions.size(), Vec3(-5.0, 0.0, 0.0));  // nothing stops it at x = 0
  mpm::Simulation simulation(d, {1});
  try {
    for (int i = 0; i < 100; ++i) simulation.advance();
    FAIL() << "left the domain unnoticed";
  } catch (const mpm::PhysicsError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("outside the domain"), std::string::npos) << text;
    EXPECT_NE(text.find("particle "), std::string::npos) << text;
    EXPECT_NE(text.find("step "), std::string::npos) << text;
    EXPECT_NE(text.find("'boundaries'"), std::string::npos) << text;
  }
  EXPECT_EQ(simulation.particles(), 512u);
}

}  // namespace conservation_test
