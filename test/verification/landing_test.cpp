// A block falls onto a rigid floor and bounces: contact must not create energy.
//
// The floor does not move and so does no work, and the work of gravity is in the potential energy. Contact at nodes is
// inelastic, so kinetic + elastic + potential energy may only fall. 1 % is allowed for the drift of the schemes over
// the bounce.
#include <gtest/gtest.h>

#include <limits>

#include "mpm/simulation/simulation.hpp"
#include "particle_block.hpp"

namespace landing_test {

using mpm::Vec3;

enum class Floor { wall, box };

class Landing : public testing::TestWithParam<std::tuple<mpm::UpdateScheme, Floor, double>> {};
INSTANTIATE_TEST_SUITE_P(Schemes, Landing,
                         testing::Combine(testing::Values(mpm::UpdateScheme::usf, mpm::UpdateScheme::usavg),
                                          testing::Values(Floor::wall, Floor::box),
                                          testing::Values(0.0, 0.37)));  // height of the floor above a node [cells]

TEST_P(Landing, CreatesNoEnergy) {
  const auto [update, floor, offset] = GetParam();
  if (floor == Floor::wall && offset > 0.0) GTEST_SKIP() << "walls lie on nodes";
  const double h = 0.02;
  mpm::SimulationDefinition d;
  d.geometry = mpm::GeometryKind::plane_strain;
  d.grid = {Vec3::Constant(h), Vec3(0.0, 0.0, floor == Floor::wall ? 0.1 : 0.0), Vec3(0.4, 0.0, 0.5)};
  d.time.sync = 5'000'000;
  d.method.update = update;
  d.gravity = {0.0, 0.0, -9.81};
  d.materials = {{"rubber", 1000.0, mpm::NeoHookeanDefinition{{0.5e6, 0.3}}}};
  mpm::DeformableBody body;
  body.name = "block";
  body.material = "rubber";
  body.particle_volume = h * h / 4.0;
  body.positions = particle_block(d.geometry, {0.1, 0.0, 0.2}, {10, 1, 10}, h / 2);
  body.velocities.assign(body.positions.size(), Vec3(0.0, 0.0, -2.0));
  d.bodies = {body};
  const mpm::FrictionLaw friction{0.5, false};
  if (floor == Floor::wall) {
    d.walls[4] = {mpm::WallKind::frictional, friction};
  } else {
    mpm::RigidBodyDefinition box;
    box.name = "floor";
    const double endless = std::numeric_limits<double>::infinity();
    box.surface = mpm::make_box({1.0, endless, 0.2});
    box.pose.position = {0.2, 0.0, offset * h};
    box.friction = friction;
    d.rigid_bodies = {box};
  }
  mpm::Simulation simulation(d, {1});
  const mpm::EnergyReport start = simulation.state().energy;
  const double floor_energy = 10.0 * 9.81 * 0.1;  // potential energy of 10 kg at the height of the floor [J]
  double most = 0.0, strain = 0.0, upward = 0.0;
  for (int i = 0; i < 60; ++i) {
    simulation.advance();
    const mpm::SolverState state = simulation.state();
    most = std::max(most, state.energy.total());
    strain = std::max(strain, state.energy.of("elastic"));
    upward = std::max(upward, state.audit.momentum.z());
  }
  RecordProperty("energy_gain", std::to_string(most / start.total() - 1.0));
  EXPECT_GT(strain, 0.2 * start.of("kinetic"));  // it has landed
  EXPECT_GT(upward, 0.0);                        // and bounced
  EXPECT_LT(most - start.total(), 0.01 * (start.total() - floor_energy));
}

}  // namespace landing_test
