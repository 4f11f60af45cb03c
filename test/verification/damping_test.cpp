// Damping with each rate and placement against known motions, and the balance of the accounts. Source: method reference
// 6.1 to 6.5; exact-solutions 29.
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/simulation/simulation.hpp"
#include "particle_block.hpp"
#include "scene_run.hpp"

namespace damping_test {

using mpm::DampingDefinition;
using mpm::Function;
using mpm::Vec3;
using verification::field;
using verification::seconds;

constexpr double kCell = 0.1;

// A soft free block of 4 cells along each edge in a domain of 4 m.
mpm::SimulationDefinition block(mpm::GeometryKind geometry, mpm::UpdateScheme update) {
  mpm::SimulationDefinition d;
  d.geometry = geometry;
  d.method.update = update;
  d.grid = {Vec3::Constant(kCell), Vec3::Zero(), Vec3::Constant(4.0)};
  d.time.sync = 10'000'000;
  d.materials = {{"m", 1000.0, mpm::NeoHookeanDefinition{{1e5, 0.3}}}};
  mpm::DeformableBody body;
  body.name = "block";
  body.material = "m";
  const bool solid = geometry == mpm::GeometryKind::solid;
  body.particle_volume = std::pow(kCell / 2, solid ? 3 : 2);
  body.positions = particle_block(geometry, mpm::Vec3::Ones(), {8, 8, 8}, kCell / 2);
  d.bodies = {body};
  return d;
}

void move(mpm::SimulationDefinition& d, const Vec3& velocity) {
  d.bodies[0].velocities.assign(d.bodies[0].positions.size(), velocity);
}

// Gives velocities by which the block stretches and shears by some per cent.
void shake(mpm::SimulationDefinition& d) {
  d.bodies[0].velocities.clear();
  for (const Vec3& x : d.bodies[0].positions) {
    d.bodies[0].velocities.emplace_back(2.0 * std::sin(3.0 * x.x()) + x.z(), 0.3 * x.y(), -1.0 * x.x());
  }
}

Vec3 impulse(const mpm::SolverState& state, const std::string& name) {
  for (const mpm::NamedImpulse& entry : state.audit.impulses) {
    if (entry.name == name) return entry.impulse;
  }
  ADD_FAILURE() << "no impulse is called " << name;
  return Vec3::Zero();
}

class Damping : public testing::TestWithParam<std::tuple<mpm::GeometryKind, mpm::UpdateScheme>> {
 protected:
  mpm::SimulationDefinition definition() const { return block(std::get<0>(GetParam()), std::get<1>(GetParam())); }
};
INSTANTIATE_TEST_SUITE_P(Methods, Damping,
                         testing::Combine(testing::Values(mpm::GeometryKind::plane_strain, mpm::GeometryKind::solid),
                                          testing::Values(mpm::UpdateScheme::usf, mpm::UpdateScheme::usavg)));

// Grid damping on the nodes, grid damping in the update and particle damping act alike on a translation. Velocity is
// multiplied by (1 - k dt) in a step, so that the kinetic energy falls as exp(-2 k t) (exact-solutions 29).
TEST_P(Damping, SlowsRigidTranslation) {
  const double k = 3.0;
  DampingDefinition on_nodes(k), in_update(k), of_particles;
  in_update.in_force = false;
  of_particles.particle = k;
  for (const DampingDefinition& damping : {on_nodes, in_update, of_particles}) {
    auto d = definition();
    d.method.damping = damping;
    move(d, {1.0, 0.0, -0.5});
    mpm::Simulation simulation(d, {1});
    const mpm::SolverState start = simulation.state();
    for (int i = 0; i < 20; ++i) simulation.advance();
    const mpm::SolverState state = simulation.state();
    const double kept = std::pow(1.0 - k * state.step.dt_last, static_cast<double>(state.step.steps));
    EXPECT_EQ(state.step.dt_min, state.step.dt_max);  // one dt for the power
    // Round-off of one digit in each of some hundred steps.
    EXPECT_NEAR(state.energy.of("kinetic") / start.energy.of("kinetic"), kept * kept, 1e-11);
    // (1 - k dt)^2 differs from exp(-2 k dt) by (k dt)^2, which adds up to k^2 t dt = 9 * 0.2 * 0.005 at most.
    EXPECT_NEAR(state.energy.of("kinetic") / start.energy.of("kinetic"), std::exp(-2.0 * k * 0.2), 0.01);
    EXPECT_NEAR((impulse(state, "damping") - start.audit.momentum * (kept - 1.0)).norm(), 0.0,
                1e-11 * start.audit.momentum.norm());
    EXPECT_LT(state.audit.residual, 1e-10);
  }
}

// The same holds for every transfer, including the velocity that XPIC and FMPM take from the grid (method reference
// 6.6). APIC is damped on the nodes.
TEST_P(Damping, SlowsWhateverIsTransferred) {
  using mpm::TransferKind;
  const double k = 3.0;
  DampingDefinition on_nodes(k), in_update;
  in_update.grid = 2.0;
  in_update.particle = k - 2.0;
  in_update.in_force = false;
  for (const mpm::Transfer transfer :
       {mpm::Transfer{TransferKind::flip, 0.9, 0}, mpm::Transfer{TransferKind::flip, 0.0},
        mpm::Transfer{TransferKind::xpic, 1.0, 3}, mpm::Transfer{TransferKind::fmpm, 1.0, 2},
        mpm::Transfer{TransferKind::apic}}) {
    for (const DampingDefinition& damping : {on_nodes, in_update}) {
      if (transfer.kind == TransferKind::apic && !damping.in_force) continue;
      auto d = definition();
      d.method.transfer = transfer;
      d.method.damping = damping;
      move(d, {1.0, 0.0, -0.5});
      mpm::Simulation simulation(d, {1});
      const double before = simulation.state().audit.momentum.x();
      for (int i = 0; i < 10; ++i) simulation.advance();
      const mpm::SolverState state = simulation.state();
      const double kept = std::pow(1.0 - k * state.step.dt_last, static_cast<double>(state.step.steps));
      const auto which = testing::Message() << "transfer " << static_cast<int>(transfer.kind) << ", in the "
                                            << (damping.in_force ? "force" : "update");
      EXPECT_NEAR(state.audit.momentum.x() / before, kept, 1e-11) << which;
      EXPECT_LT(state.audit.residual, 1e-10) << which;
    }
  }
}

// A body that deforms is damped in every way that a transfer has: the account contains the momentum removed.
TEST_P(Damping, AuditClosesForEveryTransfer) {
  using mpm::TransferKind;
  for (const TransferKind kind : {TransferKind::flip, TransferKind::xpic, TransferKind::fmpm, TransferKind::apic}) {
    auto d = definition();
    d.method.transfer = {kind, 1.0, 3};
    d.method.damping.grid = 4.0;
    if (kind != TransferKind::apic) {
      d.method.damping.particle = Function::parse("3*x");
      d.method.damping.in_force = false;
    }
    d.method.damping.feedback = mpm::FeedbackDefinition{0.5, 0.0, 50.0};
    shake(d);
    mpm::Simulation simulation(d, {2});
    for (int i = 0; i < 10; ++i) simulation.advance();
    EXPECT_GT(impulse(simulation.state(), "damping").norm(), 0.0);
    EXPECT_LT(simulation.state().audit.residual, 1e-10) << static_cast<int>(kind);
  }
}

// A rate that is a function of time is read at the middle of each step.
TEST_P(Damping, FollowsAFunctionOfTime) {
  DampingDefinition on_nodes, in_update, of_particles;
  on_nodes.grid = in_update.grid = of_particles.particle = Function::parse("1+20*t");
  in_update.in_force = false;
  for (const DampingDefinition& damping : {on_nodes, in_update, of_particles}) {
    auto d = definition();
    d.method.damping = damping;
    d.time.step = 1e-3;  // always used, since waves allow a larger step
    move(d, {1.0, 0.0, -0.5});
    mpm::Simulation simulation(d, {1});
    const double before = simulation.state().audit.momentum.x();
    for (int i = 0; i < 20; ++i) simulation.advance();
    ASSERT_EQ(simulation.state().step.steps, 200u);
    double kept = 1.0;
    for (int n = 0; n < 200; ++n) kept *= 1.0 - 1e-3 * (1.0 + 20.0 * (n + 0.5) * 1e-3);
    EXPECT_NEAR(simulation.state().audit.momentum.x() / before, kept, 1e-12);
  }
}

// Method reference 6.3: grid damping in the force and in the update are the same at nodes without a constraint.
TEST_P(Damping, BothPlacementsAgree) {
  const auto run = [&](bool in_force) {
    auto d = definition();
    d.gravity = {0.0, 0.0, -3.0};
    d.method.damping.grid = Function::parse("20+100*t");
    d.method.damping.particle = 3.0;
    d.method.damping.pic = 0.02;
    d.method.damping.in_force = in_force;
    shake(d);
    mpm::Simulation simulation(d, {1});
    for (int i = 0; i < 20; ++i) simulation.advance();
    return simulation;
  };
  const mpm::Simulation force = run(true), update = run(false);
  EXPECT_EQ(force.state().step.steps, update.state().step.steps);
  for (const char* name : {"x", "z", "vx", "vz", "sxx", "sxz"}) {
    const std::vector<double> a = field(force, name), b = field(update, name);
    double scale = 0.0, worst = 0.0;
    for (std::size_t p = 0; p < a.size(); ++p) {
      scale = std::max(scale, std::abs(a[p]));
      worst = std::max(worst, std::abs(a[p] - b[p]));
    }
    // Sums over nodes differ from sums over particles by round-off, which grows over some tens of steps.
    EXPECT_LT(worst, 1e-10 * scale) << name;
  }
  EXPECT_LT(update.state().audit.residual, 1e-10);
}

// Damping as a function of place: only material beyond x = 1.25 m is slowed.
TEST_P(Damping, OfPlaceActsThereAlone) {
  for (const bool of_grid : {true, false}) {
    auto d = definition();
    d.materials[0].law = mpm::NeoHookeanDefinition{{1e-6, 0.3}};  // practically without stiffness
    d.time.step = 1e-3;
    const Function rate = Function::parse("5*(x>1.25)");
    (of_grid ? d.method.damping.grid : d.method.damping.particle) = rate;
    d.method.damping.in_force = false;
    move(d, {0.0, 0.0, 1.0});
    const std::vector<Vec3> start = d.bodies[0].positions;
    mpm::Simulation simulation(d, {1});
    simulation.advance();
    const std::vector<double> v = field(simulation, "vz");
    for (std::size_t p = 0; p < v.size(); ++p) {
      // In a period of ten steps only the local rate acts on particles away from the border.
      if (start[p].x() > 1.25 + kCell) {
        EXPECT_LT(v[p], 1.0 - 0.04);  // exp(-5 * 0.01)
      }
      if (start[p].x() < 1.25 - kCell) {
        EXPECT_NEAR(v[p], 1.0, 1e-3);
      }
    }
    EXPECT_LT(impulse(simulation.state(), "damping").z(), 0.0);
    EXPECT_LT(simulation.state().audit.residual, 1e-10);
  }
}

// Feedback with target 0 on a body in translation: v = v0 sech(sqrt(K) v0 t) (unit tests have the equation).
TEST_P(Damping, FeedbackStopsARigidTranslation) {
  using Of = mpm::FeedbackDefinition::Of;
  const double gain = 40.0, v0 = 1.0;
  DampingDefinition on_nodes, in_update, of_particles;
  for (DampingDefinition* damping : {&on_nodes, &in_update, &of_particles}) {
    damping->feedback = mpm::FeedbackDefinition{gain, 0.0, std::numeric_limits<double>::infinity(), Of::grid};
  }
  in_update.in_force = false;
  of_particles.feedback->of = Of::particle;
  for (const DampingDefinition& damping : {on_nodes, in_update, of_particles}) {
    auto d = definition();
    d.method.damping = damping;
    d.time.step = 1e-3;
    move(d, {v0, 0.0, 0.0});
    mpm::Simulation simulation(d, {1});
    for (int i = 0; i < 40; ++i) simulation.advance();
    const double exact = v0 / std::cosh(std::sqrt(gain) * v0 * 0.4);
    // The error is of first order: sqrt(K) v0 dt / 2 = 0.3 %; twice that is allowed.
    for (const double v : field(simulation, "vx")) EXPECT_NEAR(v, exact, 0.006 * v0);
    EXPECT_LT(simulation.state().audit.residual, 1e-10);
  }
}

// Everything at once, against a wall: the accounts of all sources close the balance for any number of threads.
TEST_P(Damping, AuditClosesWithEverything) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2}) {
    auto d = definition();
    d.gravity = {0.0, 0.0, -9.81};
    d.walls[4] = {mpm::WallKind::frictional, {0.3, false}};
    d.method.damping.grid = Function::parse("2+x+t");
    d.method.damping.particle = Function::parse("z");
    d.method.damping.pic = Function::parse("0.1*(x>1.2)");
    d.method.damping.feedback = mpm::FeedbackDefinition{0.5, Function::parse("t"), 50.0};
    d.method.damping.in_force = false;
    shake(d);
    for (Vec3& v : d.bodies[0].velocities) v.z() -= 5.0;
    mpm::Simulation simulation(d, {threads});
    for (int i = 0; i < 30; ++i) simulation.advance();
    const mpm::SolverState state = simulation.state();
    EXPECT_GT(impulse(state, "wall/z_min").z(), 0.0);
    EXPECT_GT(impulse(state, "damping").norm(), 0.0);
    EXPECT_LT(state.audit.residual, 1e-10);
    hashes.push_back(simulation.state_hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

// A bar's first mode under grid damping k: u'' + k u' + w^2 u = 0, whose energy falls as exp(-k t) from period to
// period, half as fast as that of a translation (exact-solutions 29; 0.998 k was measured there).
TEST(DampingOfABar, VibrationLosesEnergyHalfAsFast) {
  const double k = 20.0, period = 0.04;  // k / w = 0.13
  for (const char* damping : {"{grid: 20, placement: force}", "{grid: 20, placement: update}", "{particle: 20}"}) {
    mpm::Simulation simulation = verification::start(
        "vibrating_bar",
        {std::string("method.damping=") + damping, "bodies.bar.initial.velocity=['0.01*sin(pi*x/2)', 0]"});
    const double start = simulation.state().energy.total();
    verification::run_until(simulation, 3.0 * period);
    const double measured = -std::log(simulation.state().energy.total() / start) / (3.0 * period);
    EXPECT_NEAR(measured / k, 1.0, 0.02) << damping;
  }
}

// A rate that would reverse velocities within a step ends the run with a clear error, and so does a negative rate. The
// first rate peaks between the three times at which a period's largest rate is sought.
TEST(DampingOfABar, EndsTheRunWhereItCannotBe) {
  for (const char* rate : {"t>0.1005 && t<0.1035 ? 1e6 : 0", "1-20*t"}) {
    auto d = block(mpm::GeometryKind::plane_strain, mpm::UpdateScheme::usf);
    d.method.damping.grid = Function::parse(rate);
    move(d, {1.0, 0.0, 0.0});
    mpm::Simulation simulation(d, {1});
    try {
      for (int i = 0; i < 20; ++i) simulation.advance();
      ADD_FAILURE() << rate << " was taken";
    } catch (const mpm::PhysicsError& error) {
      EXPECT_EQ(std::string(error.what()).find("method.damping at t = "), 0u) << error.what();
    }
  }
}

// The largest rate of a period limits its steps: cfl / (alpha_g + alpha_p).
TEST(DampingOfABar, LimitsTheStep) {
  auto d = block(mpm::GeometryKind::plane_strain, mpm::UpdateScheme::usf);
  d.method.damping.grid = Function::parse("1000*t");
  move(d, {1.0, 0.0, 0.0});
  mpm::Simulation simulation(d, {1});
  for (int i = 0; i < 100; ++i) simulation.advance();
  EXPECT_EQ(simulation.state().step.limited_by, "method.damping");
  EXPECT_LE(simulation.state().step.dt_last, 0.5 / 1000.0);
  EXPECT_GT(simulation.state().step.dt_last, 0.9 * 0.5 / 1000.0);
}

}  // namespace damping_test
