// Limits of a run: particles that leave slowly, tools that start at full speed, conditions that would destabilise it,
// impossible definitions.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "mpm/simulation/simulation.hpp"

namespace limits_test {

using mpm::Vec3;

// A row of columns of particles, plane strain, cell 0.1 m, domain 2 m by 2 m.
mpm::SimulationDefinition block(double x_from, double x_to, double height, double young = 1e5) {
  mpm::SimulationDefinition d;
  d.geometry = mpm::GeometryKind::plane_strain;
  d.grid = {Vec3::Constant(0.1), Vec3::Zero(), Vec3::Constant(2.0)};
  d.time.sync = 10'000'000;
  d.materials = {{"m", 1000.0, mpm::NeoHookeanDefinition{{young, 0.3}}}};
  mpm::DeformableBody body;
  body.name = "block";
  body.material = "m";
  body.particle_volume = 0.0025;
  for (double x = x_from + 0.025; x < x_to; x += 0.05) {
    for (double z = 0.025; z < height; z += 0.05) body.positions.emplace_back(x, 0.0, z);
  }
  d.bodies = {body};
  return d;
}

template <class Action>
std::string physics_error(Action&& action) {
  try {
    action();
  } catch (const mpm::PhysicsError& error) {
    return error.what();
  }
  return "";
}

void set_velocity(mpm::SimulationDefinition& d, const Vec3& velocity) {
  d.bodies[0].velocities.assign(d.bodies[0].positions.size(), velocity);
}

TEST(Limits, NoticesASlowParticleOutsideAtOnce) {
  auto d = block(1.8, 2.0, 1.0);
  set_velocity(d, {0.1, 0.0, 0.0});
  mpm::Simulation simulation(d, {1});
  const std::string text = physics_error([&] {
    for (int i = 0; i < 100; ++i) simulation.advance();
  });
  EXPECT_NE(text.find("outside the domain"), std::string::npos) << text;
  // The last column starts 0.025 m from the border: outside after 0.25 s.
  EXPECT_NEAR(1e-9 * static_cast<double>(simulation.time()), 0.24, 0.011);
  EXPECT_NE(physics_error([&] { simulation.advance(); }), "");  // and it stays failed
}

// Soft material thrown at a wall moves up to half a particle's box beyond it, and comes back.
TEST(Limits, ParticlesPressedAgainstAWallStayInTheRun) {
  auto d = block(0.0, 0.5, 0.5, 2e4);
  set_velocity(d, {-5, 0.0, 0.0});
  d.walls[0].kind = d.walls[4].kind = mpm::WallKind::slip;
  mpm::Simulation simulation(d, {1});
  std::vector<double> x;
  double lowest = 0.0;
  for (int i = 0; i < 20; ++i) {
    simulation.advance();
    simulation.particle_field("x", x);
    lowest = std::min(lowest, *std::min_element(x.begin(), x.end()));
  }
  EXPECT_LT(lowest, 0.0);
  EXPECT_GE(lowest, -0.025);
  EXPECT_GT(simulation.state().audit.momentum.x(), 0.0);
}

// Rigid translation across every node with a whole number of steps per cell: positions are an ulp from the border of a
// tile.
TEST(Limits, CrossesTilesOnAlignedLattices) {
  auto d = block(0.1, 0.6, 0.5);
  set_velocity(d, {1.0, 0.0, 0.5});
  d.time.step = 0.0025;
  mpm::Simulation simulation(d, {1});
  for (int i = 0; i < 100; ++i) simulation.advance();
  std::vector<double> x;
  simulation.particle_field("x", x);
  for (std::size_t p = 0; p < x.size(); ++p) EXPECT_NEAR(x[p], d.bodies[0].positions[p].x() + 1.0, 1e-12);
}

// A tool has full speed from the first step, by a function, and the step respects it in the first period.
TEST(Limits, CountsAToolsSpeedBeforeItMoves) {
  auto d = block(0.1, 0.5, 0.5);
  mpm::RigidBodyDefinition tool;
  tool.name = "tool";
  tool.surface = mpm::make_box({0.4, 10.0, 0.4});
  tool.pose.position = {1.5, 0.0, 1.5};
  tool.velocity[0] = mpm::Function(-40.0);
  d.rigid_bodies = {tool};
  mpm::Simulation simulation(d, {1});
  simulation.advance();
  const mpm::StepReport step = simulation.state().step;
  EXPECT_LE(step.dt_max * 40.0, 0.5 * 0.1);
  EXPECT_EQ(step.limited_by.rfind("speed of 'tool'", 0), 0u) << step.limited_by;
}

// Two bodies, one four times as stiff: it limits the step, and the reported place lies in it. At rest and undeformed
// the limit is cfl h / sqrt((K + 4 G / 3) / rho).
TEST(Limits, NamesTheBodyThatLimitsTheStepAndThePlace) {
  auto d = block(0.1, 0.5, 0.5);
  auto stiff = block(1.0, 1.4, 0.5, 4e5);
  stiff.materials[0].name = "stiff";
  stiff.bodies[0].name = "second";
  stiff.bodies[0].material = "stiff";
  d.materials.push_back(stiff.materials[0]);
  d.bodies.push_back(stiff.bodies[0]);
  mpm::Simulation simulation(d, {1});
  simulation.advance();
  const mpm::StepReport step = simulation.state().step;
  EXPECT_EQ(step.limited_by.rfind("wave speed of 'second'", 0), 0u) << step.limited_by;
  double x = 0.0, y = 0.0, z = 0.0;
  const std::size_t at = step.limited_by.find("at (");
  ASSERT_NE(at, std::string::npos) << step.limited_by;
  ASSERT_EQ(std::sscanf(step.limited_by.c_str() + at, "at (%lf, %lf, %lf) m", &x, &y, &z), 3);
  EXPECT_TRUE(x > 1.0 && x < 1.4 && z > 0.0 && z < 0.5) << step.limited_by;
  const double modulus = 4e5 * 0.7 / (1.3 * 0.4);  // E (1 - nu) / ((1 + nu) (1 - 2 nu))
  const double limit = 0.5 * 0.1 / std::sqrt(modulus / 1000.0);
  const double steps = std::ceil(0.01 / limit - 1e-9);
  EXPECT_NEAR(step.dt_last, 0.01 / steps, 1e-12);
}

// Tait's fluid is compressed by a piston: c^2 = K/rho J^(1 - n). The step falls with it and respects the tangent at the
// densest particle. It never exceeded the limit, or the run would have ended.
TEST(Limits, FollowsWhatStiffens) {
  auto d = block(0.0, 2.0, 1.0);
  const double bulk = 1e5, exponent = 7.0;
  d.materials[0].law = mpm::NewtonianFluidDefinition{bulk, exponent, 0.0, false};
  d.walls[0].kind = d.walls[1].kind = d.walls[4].kind = mpm::WallKind::slip;
  mpm::RigidBodyDefinition piston;
  piston.name = "piston";
  piston.surface = mpm::make_box({3.0, std::numeric_limits<double>::infinity(), 0.6});
  piston.pose.position = {1.0, 0.0, 1.3};
  piston.velocity[2] = mpm::Function(-1.0);
  d.rigid_bodies = {piston};
  mpm::Simulation simulation(d, {1});
  simulation.advance();
  const double first = simulation.state().step.dt_last;
  while (simulation.time() < 200'000'000) simulation.advance();
  const mpm::SolverState state = simulation.state();
  EXPECT_LT(state.min_j, 0.85);
  const double speed = std::sqrt(bulk / 1000.0 * std::pow(state.min_j, 1.0 - exponent));
  EXPECT_LE(state.step.dt_last, 0.5 * 0.1 / speed * (1.0 + 0.05));  // the last period changes J by 1 %, c by 3 %
  EXPECT_LT(state.step.dt_last, 0.7 * first);
}

// A plane is infinite, so for a turn the size of the domain counts.
TEST(Limits, ATurningPlaneIsAsLargeAsTheDomain) {
  auto d = block(0.1, 0.5, 0.5);
  mpm::RigidBodyDefinition plane;
  plane.name = "plane";
  plane.surface = mpm::make_plane(mpm::Vec3::UnitZ());
  plane.pose.position = {0.0, 0.0, -50.0};
  plane.rotation_rate[1] = mpm::Function(20.0);
  d.rigid_bodies = {plane};
  mpm::Simulation simulation(d, {1});
  simulation.advance();
  const mpm::Vec3 size = d.grid.max - d.grid.min;
  EXPECT_LE(simulation.state().step.dt_max, d.time.cfl * d.grid.cell.x() / (20.0 * std::hypot(size.x(), size.z())));
}

TEST(Limits, KeepsStrongDampingStable) {
  auto d = block(0.1, 0.5, 0.5);
  d.method.damping = 5000.0;
  set_velocity(d, {1.0, 0.0, 0.0});
  mpm::Simulation simulation(d, {1});
  for (int i = 0; i < 5; ++i) simulation.advance();
  EXPECT_EQ(simulation.state().step.limited_by, "method.damping");
  EXPECT_LT(std::abs(simulation.state().audit.momentum.x()), 1e-9);
}

// y does not exist in a planar scene: the audit closes whatever values a definition has along y.
TEST(Limits, PlanarScenesIgnoreY) {
  auto d = block(0.1, 0.9, 0.5);
  d.gravity = {0.0, 3.0, -9.81};
  d.walls[4].kind = mpm::WallKind::slip;
  mpm::RigidBodyDefinition tool;
  tool.name = "tool";
  tool.surface = mpm::make_box({0.4, std::numeric_limits<double>::infinity(), 0.4});
  tool.pose.position = {0.5, 0.7, 0.69};
  tool.velocity = {mpm::Function(0.2), mpm::Function(5.0), mpm::Function(-0.1)};
  tool.friction.coefficient = 0.3;
  d.rigid_bodies = {tool};
  mpm::Simulation simulation(d, {1});
  for (int i = 0; i < 20; ++i) simulation.advance();
  EXPECT_LT(simulation.state().audit.residual, 1e-10);
  EXPECT_NE(simulation.take_contact(0).mean.force.z(), 0.0);
  EXPECT_EQ(simulation.bodies()[0].pose.position.y(), 0.0);
  // Half a turn about x leaves the plane.
  EXPECT_THROW(simulation.command_pose(0, {{0.5, 0.0, 0.7}, mpm::Quat(0, 1, 0, 0)}, simulation.time() + 1),
               mpm::RigidError);
}

TEST(Limits, RefusesDefinitionsThatCannotBe) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto refused = [](auto&& change) {
    auto d = block(0.1, 0.5, 0.5);
    change(d);
    EXPECT_THROW(mpm::Simulation(d, {1}), mpm::DefinitionError);
  };
  refused([](auto& d) { d.time.step = -1.0; });
  refused([](auto& d) { d.time.sync = 0; });
  refused([](auto& d) { d.time.cfl = 1.0; });
  refused([&](auto& d) { d.gravity.z() = nan; });
  refused([](auto& d) { d.method.damping = std::numeric_limits<double>::infinity(); });
  refused([](auto& d) { d.method.transfer.flip = 1.1; });
  refused([](auto& d) { d.bodies.clear(); });
  refused([](auto& d) { d.bodies[0].material = "none"; });
  refused([](auto& d) { d.bodies[0].velocities.resize(3); });
  refused([](auto& d) { d.bodies[0].positions[7].x() = 2.5; });
  refused([&](auto& d) { set_velocity(d, {nan, 0.0, 0.0}); });
}

}  // namespace limits_test
