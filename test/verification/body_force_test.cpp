// Body forces as functions of time, position and initial position: their effect on bodies that move as a whole, where
// the motion is known, and closed accounts.
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/simulation/simulation.hpp"
#include "particle_block.hpp"

namespace body_force_test {

using mpm::Function;
using mpm::Vec3;

constexpr double kCell = 0.1;
constexpr double kDensity = 1000.0;

Function at_start(const std::string& expression) {
  return Function::parse(expression, {}, mpm::FunctionPlaces::present_and_start);
}

// A block of `cells` cells along each edge with its lower corner at (x, ., 0.5).
mpm::DeformableBody block(const std::string& name, mpm::GeometryKind geometry, int cells, double x) {
  const bool solid = geometry == mpm::GeometryKind::solid;
  mpm::DeformableBody body;
  body.name = name;
  body.material = "m";
  body.particle_volume = std::pow(kCell / 2, solid ? 3 : 2);
  body.positions = particle_block(geometry, {x, 0.5, 0.5}, {2 * cells, 2 * cells, 2 * cells}, kCell / 2);
  return body;
}

class BodyForceOf : public testing::TestWithParam<std::tuple<mpm::GeometryKind, mpm::UpdateScheme>> {
 protected:
  mpm::SimulationDefinition definition(const mpm::LawDefinition& law, int cells = 3) const {
    mpm::SimulationDefinition d;
    d.geometry = std::get<0>(GetParam());
    d.method.update = std::get<1>(GetParam());
    d.grid = {Vec3::Constant(kCell), Vec3::Zero(), Vec3::Constant(4.0)};
    d.time.sync = 10'000'000;
    d.materials = {{"m", kDensity, law}};
    d.bodies = {block("block", d.geometry, cells, 0.5)};
    return d;
  }
  double mass(const mpm::DeformableBody& body) const {
    return kDensity * body.particle_volume * static_cast<double>(body.positions.size());
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, BodyForceOf,
                         testing::Combine(testing::Values(mpm::GeometryKind::plane_strain, mpm::GeometryKind::solid),
                                          testing::Values(mpm::UpdateScheme::usf, mpm::UpdateScheme::usavg)));

Vec3 impulse(const mpm::SolverState& state, const std::string& name) {
  for (const mpm::NamedImpulse& entry : state.audit.impulses) {
    if (entry.name == name) return entry.impulse;
  }
  ADD_FAILURE() << "no impulse is called " << name;
  return Vec3::Zero();
}

// A uniform acceleration is equivalent to gravity: a block that lands on a wall moves in the same way to round-off.
TEST_P(BodyForceOf, UniformIsGravity) {
  const Vec3 g(1.0, 0.0, -9.81);
  auto falling = definition(mpm::NeoHookeanDefinition{{1e5, 0.3}});
  falling.walls[4] = {mpm::WallKind::frictional, {0.3, false}};
  auto pushed = falling;
  falling.gravity = g;
  pushed.body_forces = {{"", {Function(g.x()), Function(), Function(g.z())}}};
  mpm::Simulation a(falling, {1}), b(pushed, {1});
  for (int i = 0; i < 45; ++i) {  // falls 0.5 m in 0.32 s
    a.advance();
    b.advance();
  }
  EXPECT_GT(impulse(a.state(), "wall/z_min").z(), 0.1);
  for (const char* name : {"x", "z", "vx", "vz", "szz"}) {
    std::vector<double> of_a, of_b;
    a.particle_field(name, of_a);
    b.particle_field(name, of_b);
    double scale = 0.0, worst = 0.0;
    for (std::size_t p = 0; p < of_a.size(); ++p) {
      scale = std::max(scale, std::abs(of_a[p]));
      worst = std::max(worst, std::abs(of_a[p] - of_b[p]));
    }
    // (f + m g) / m against f / m + g: round-off of some hundred steps, which grows in the bounce.
    EXPECT_LT(worst, 1e-9 * scale) << name;
  }
  EXPECT_LT((impulse(a.state(), "gravity") - impulse(b.state(), "body_force")).norm(),
            1e-12 * impulse(a.state(), "gravity").norm());
  EXPECT_LT(b.state().audit.residual, 1e-10);  // over the momentum exchanged, as README.md promises for every run
}

// b = -w^2 (x - X) is the same for all particles of a block that moves as a whole, which therefore oscillates as u =
// v0/w sin(w t). The error falls by four when the step is halved.
TEST_P(BodyForceOf, SpringToTheStartIsSecondOrder) {
  const double w = 2.0 * M_PI, v0 = 1.0;
  const auto error = [&](double step) {
    auto d = definition(mpm::NeoHookeanDefinition{{1e3, 0.3}});
    d.time.step = step;
    d.bodies[0].velocities.assign(d.bodies[0].positions.size(), Vec3(v0, 0.0, 0.0));
    d.body_forces = {{"block", {at_start("-(2*pi)^2*(x-X)"), Function(), Function()}}};
    const double start = d.bodies[0].positions[0].x();
    mpm::Simulation simulation(d, {1});
    for (int i = 0; i < 30; ++i) simulation.advance();
    std::vector<double> x, j;
    simulation.particle_field("x", x);
    simulation.particle_field("j", j);
    for (const double ratio : j) EXPECT_NEAR(ratio, 1.0, 1e-10);  // it moved as a whole
    const mpm::SolverState state = simulation.state();
    EXPECT_LT(state.audit.residual, 1e-10);
    // All work becomes kinetic energy, to round-off of the energy that it started with.
    const double kinetic = 0.5 * mass(d.bodies[0]) * v0 * v0;
    EXPECT_NEAR(state.energy.of("load_work"), state.energy.of("kinetic") - kinetic, 1e-10 * kinetic);
    return std::abs(x[0] - start - v0 / w * std::sin(w * 0.3));
  };
  const double coarse = error(5e-3), fine = error(2.5e-3);
  EXPECT_LT(coarse, 1e-3);
  // Two, minus the effect of the next term of the error at 200 steps per oscillation.
  EXPECT_GT(std::log2(coarse / fine), 1.95);
}

// The impulse is the integral of m b over time, by the midpoint rule: for b = cos(w t) its error is (w dt)^2 / 24.
TEST_P(BodyForceOf, ImpulseIsTheIntegralOverTime) {
  auto d = definition(mpm::NeoHookeanDefinition{{1e5, 0.3}});
  d.body_forces = {{"", {Function(), Function(), Function::parse("cos(5*t)")}},
                   {"block", {Function(2.0), Function(), Function()}}};
  mpm::Simulation simulation(d, {1});
  for (int i = 0; i < 20; ++i) simulation.advance();
  const mpm::SolverState state = simulation.state();
  const double m = mass(d.bodies[0]), w_dt = 5.0 * state.step.dt_max;
  const double exact = m * std::sin(5.0 * 0.2) / 5.0;
  EXPECT_NEAR(state.audit.momentum.z(), exact, 1.01 * w_dt * w_dt / 24.0 * exact);
  EXPECT_NEAR(state.audit.momentum.x(), m * 2.0 * 0.2, 1e-12 * m);
  EXPECT_LT(state.audit.residual, 1e-10);
}

// A load that depends on X only does not change while the block flies through the grid: its force is m times the mean
// of X.
TEST_P(BodyForceOf, LargePlacesStayWithTheMaterial) {
  auto d = definition(mpm::NeoHookeanDefinition{{1e5, 0.3}});
  d.bodies[0].velocities.assign(d.bodies[0].positions.size(), Vec3(5.0, 0.0, 3.0));
  d.body_forces = {{"block", {at_start("X"), Function(), at_start("Z+0*X")}}};
  mpm::Simulation simulation(d, {1});
  for (int i = 0; i < 30; ++i) simulation.advance();  // 1.5 m, across several blocks of the grid
  const Vec3 given = impulse(simulation.state(), "body_force"), centre = Vec3(0.65, 0.0, 0.65);
  EXPECT_LT((given - mass(d.bodies[0]) * 0.3 * centre).norm(), 1e-12 * given.norm());
}

TEST_P(BodyForceOf, ActsOnTheBodyItNames) {
  auto d = definition(mpm::NeoHookeanDefinition{{1e5, 0.3}});
  d.bodies.push_back(block("other", d.geometry, 3, 2.0));
  d.body_forces = {{"other", {Function(), Function(), Function(3.0)}}};
  mpm::Simulation simulation(d, {1});
  for (int i = 0; i < 10; ++i) simulation.advance();
  std::vector<double> vz;
  simulation.particle_field("vz", vz);
  const auto first = simulation.body_ids("other").first;
  for (std::size_t p = 0; p < vz.size(); ++p) EXPECT_NEAR(vz[p], p < first ? 0.0 : 0.3, 1e-13);
  d.body_forces[0].body = "nobody";
  EXPECT_THROW(mpm::Simulation(d, {1}), mpm::DefinitionError);
}

TEST_P(BodyForceOf, SameBitsForAnyNumberOfThreads) {
  std::vector<std::uint64_t> hashes;
  std::vector<double> impulses;
  for (const int threads : {1, 2, 3}) {
    auto d = definition(mpm::DruckerPragerDefinition{{1e5, 0.3}, 0.6, 0.1, 50.0}, 8);
    d.walls[4] = {mpm::WallKind::frictional, {0.4, false}};
    d.body_forces = {{"", {at_start("sin(20*t)*cos(3*x)*X"), Function(0.1), at_start("-9.81*(1+z-Z)")}}};
    mpm::Simulation simulation(d, {threads});
    for (int i = 0; i < 20; ++i) simulation.advance();
    hashes.push_back(simulation.state_hash());
    impulses.push_back(impulse(simulation.state(), "body_force").norm());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
  EXPECT_EQ(impulses[0], impulses[1]);
  EXPECT_EQ(impulses[0], impulses[2]);
}

TEST(BodyForce, NamesThePlaceWhereItIsNotFinite) {
  mpm::SimulationDefinition d;
  d.grid = {Vec3::Constant(kCell), Vec3::Zero(), Vec3::Constant(4.0)};
  d.time.sync = 10'000'000;
  d.materials = {{"m", kDensity, mpm::NeoHookeanDefinition{{1e5, 0.3}}}};
  d.bodies = {block("block", d.geometry, 2, 0.5)};
  d.body_forces = {{"", {Function(), Function::parse("t < 0.1 ? 0 : sqrt(-1)"), Function()}}};
  mpm::Simulation simulation(d, {1});
  try {
    for (int i = 0; i < 12; ++i) simulation.advance();
    FAIL() << "a load that is not a number went unnoticed";
  } catch (const mpm::PhysicsError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find("body force on 'block', along y: expression 't < 0.1 ? 0 : sqrt(-1)' is not finite at t = 0.1"),
              0u)
        << text;
    EXPECT_NE(text.find("place (0.525, 0.525, 0.525) m"), std::string::npos) << text;  // its first particle
  }
}

}  // namespace body_force_test
