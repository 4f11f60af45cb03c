// Forces on particles, spread by their domains or applied at their centres: their effect on a body however it deforms,
// and closed accounts. Source: GIMP notes (1.6), (1.18)-(1.22), (1.27).
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/simulation/simulation.hpp"
#include "particle_block.hpp"
#include "scene_run.hpp"

namespace particle_force_test {

using mpm::Function;
using mpm::LoadSpread;
using mpm::Vec3;
using verification::field;

constexpr double kCell = 0.1;
constexpr double kDensity = 1000.0;

class ParticleForce : public testing::TestWithParam<std::tuple<mpm::GeometryKind, mpm::UpdateScheme, mpm::LoadSpread>> {
 protected:
  // A soft block of 3 cells along each edge in a domain of 4 m, unsupported.
  mpm::SimulationDefinition definition() const {
    mpm::SimulationDefinition d;
    d.geometry = std::get<0>(GetParam());
    d.method.update = std::get<1>(GetParam());
    d.grid = {Vec3::Constant(kCell), Vec3::Zero(), Vec3::Constant(4.0)};
    d.time.sync = 10'000'000;
    d.materials = {{"m", kDensity, mpm::NeoHookeanDefinition{{1e5, 0.3}}}};
    mpm::DeformableBody body;
    body.name = "block";
    body.material = "m";
    const bool solid = d.geometry == mpm::GeometryKind::solid;
    body.particle_volume = std::pow(kCell / 2, solid ? 3 : 2);
    body.positions = particle_block(d.geometry, mpm::Vec3::Ones(), {6, 6, 6}, kCell / 2);
    d.bodies = {body};
    return d;
  }
  // A force on the particles of the lower two layers along x.
  mpm::ParticleForceDefinition pull(const mpm::SimulationDefinition& d, const std::array<Function, 3>& force) const {
    mpm::ParticleForceDefinition load;
    load.body = "block";
    load.force = force;
    load.spread = std::get<2>(GetParam());
    for (std::size_t p = 0; p < d.bodies[0].positions.size(); ++p) {
      if (d.bodies[0].positions[p].x() < 1.0 + kCell) load.particles.push_back(static_cast<std::uint32_t>(p));
    }
    return load;
  }
  double mass(const mpm::SimulationDefinition& d) const {
    return kDensity * d.bodies[0].particle_volume * static_cast<double>(d.bodies[0].positions.size());
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, ParticleForce,
                         testing::Combine(testing::Values(mpm::GeometryKind::plane_strain, mpm::GeometryKind::solid),
                                          testing::Values(mpm::UpdateScheme::usf, mpm::UpdateScheme::usavg),
                                          testing::Values(LoadSpread::domain, LoadSpread::center)));

Vec3 impulse(const mpm::SolverState& state, const std::string& name) {
  for (const mpm::NamedImpulse& entry : state.audit.impulses) {
    if (entry.name == name) return entry.impulse;
  }
  ADD_FAILURE() << "no impulse is called " << name;
  return Vec3::Zero();
}

double worst_difference(const mpm::Simulation& a, const mpm::Simulation& b, const std::string& name) {
  const std::vector<double> of_a = field(a, name), of_b = field(b, name);
  double scale = 0.0, worst = 0.0;
  for (std::size_t p = 0; p < of_a.size(); ++p) {
    scale = std::max(scale, std::abs(of_a[p]));
    worst = std::max(worst, std::abs(of_a[p] - of_b[p]));
  }
  return worst / scale;
}

// A total force F on some particles is an impulse F t on the body, and stretches it by some per cent.
TEST_P(ParticleForce, GivesItsImpulse) {
  auto d = definition();
  const double f = 6.0 * mass(d);
  d.particle_forces = {pull(d, {Function(-f), Function(), Function(0.5 * f)})};
  const Vec3 expected(-f * 0.2, 0.0, 0.1 * f);
  mpm::Simulation simulation(d, {1});
  for (int i = 0; i < 20; ++i) simulation.advance();
  const mpm::SolverState state = simulation.state();
  // Some hundred steps of round-off.
  EXPECT_LT((impulse(state, "particle_force") - expected).norm(), 1e-12 * expected.norm());
  EXPECT_LT((state.audit.momentum - expected).norm(), 1e-12 * expected.norm());
  EXPECT_LT(state.audit.residual, 1e-10);
  EXPECT_EQ(state.audit.impulses.size(), 2u);  // gravity, and no body force
  double widest = 0.0;
  for (const double j : field(simulation, "j")) widest = std::max(widest, std::abs(j - 1.0));
  EXPECT_GT(widest, 0.01);
}

TEST_P(ParticleForce, OnEachIsTheirNumberTimesIt) {
  auto shared = definition();
  auto each = shared;
  shared.particle_forces = {pull(shared, {Function::parse("10*cos(5*t)"), Function(), Function(2.0)})};
  each.particle_forces = shared.particle_forces;
  const auto count = static_cast<double>(each.particle_forces[0].particles.size());
  each.particle_forces[0].shared = false;
  each.particle_forces[0].force[0] = Function::parse("10*cos(5*t)/" + std::to_string(count));
  each.particle_forces[0].force[2] = Function(2.0 / count);
  mpm::Simulation a(shared, {1}), b(each, {1});
  for (int i = 0; i < 10; ++i) {
    a.advance();
    b.advance();
  }
  // The same force with other rounding: round-off of some hundred steps.
  for (const char* name : {"x", "vx", "vz", "sxx"}) EXPECT_LT(worst_difference(a, b, name), 1e-9) << name;
}

// F = M b on all particles together is the body force b, and its work is the increase of the body's energy.
TEST_P(ParticleForce, OnAllIsABodyForce) {
  auto pushed = definition();
  auto falling = pushed;
  const Vec3 b(1.0, 0.0, -9.81);
  falling.body_forces = {{"", {Function(b.x()), Function(), Function(b.z())}, std::get<2>(GetParam())}};
  pushed.particle_forces = {pull(pushed, {Function(mass(pushed) * b.x()), Function(), Function(mass(pushed) * b.z())})};
  pushed.particle_forces[0].particles.clear();
  mpm::Simulation a(falling, {1}), c(pushed, {1});
  for (int i = 0; i < 20; ++i) {
    a.advance();
    c.advance();
  }
  for (const char* name : {"x", "z", "vx", "vz"}) EXPECT_LT(worst_difference(a, c, name), 1e-9) << name;
  EXPECT_LT((impulse(a.state(), "body_force") - impulse(c.state(), "particle_force")).norm(),
            1e-12 * impulse(a.state(), "body_force").norm());
  if (std::get<2>(GetParam()) == LoadSpread::domain) {
    // It moves as a whole: all of the work is kinetic energy.
    EXPECT_NEAR(c.state().energy.of("load_work"), c.state().energy.of("kinetic"),
                1e-10 * c.state().energy.of("kinetic"));
  }
}

// The initial position moves with the particles: each particle has a spring to its initial position.
TEST_P(ParticleForce, MayBeAFunctionOfTheStart) {
  auto d = definition();
  auto load =
      pull(d, {Function::parse("50*(X-x)", {}, mpm::FunctionPlaces::present_and_start), Function(), Function()});
  load.shared = false;
  d.particle_forces = {load};
  d.bodies[0].velocities.assign(d.bodies[0].positions.size(), Vec3(1.0, 0.0, 0.0));
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 3}) {
    mpm::Simulation simulation(d, {threads});
    for (int i = 0; i < 10; ++i) simulation.advance();
    const mpm::SolverState state = simulation.state();
    EXPECT_LT(impulse(state, "particle_force").x(), 0.0);
    EXPECT_LT(state.audit.residual, 1e-10);
    hashes.push_back(simulation.state_hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST_P(ParticleForce, NamesWhatIsNotThere) {
  auto d = definition();
  d.particle_forces = {pull(d, {Function(1.0), Function(), Function()})};
  d.particle_forces[0].body = "nobody";
  EXPECT_THROW(mpm::Simulation(d, {1}), mpm::DefinitionError);
  d.particle_forces[0].body = "block";
  d.particle_forces[0].particles.push_back(100000);
  EXPECT_THROW(mpm::Simulation(d, {1}), mpm::DefinitionError);
  d.particle_forces[0].particles = {0};
  d.particle_forces[0].force[0] = Function::parse("t < 0.02 ? 0 : sqrt(-1)");
  mpm::Simulation simulation(d, {1});
  try {
    for (int i = 0; i < 5; ++i) simulation.advance();
    ADD_FAILURE() << "a force that is not finite went unnoticed";
  } catch (const mpm::PhysicsError& error) {
    EXPECT_EQ(std::string(error.what()).find("particle force on 'block', along x: "), 0u) << error.what();
  }
}

}  // namespace particle_force_test
