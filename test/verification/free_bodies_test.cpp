// Free rigid bodies alone and against material: motion without contact, balances to round-off, rest and spin.
//
// doc/free_bodies.md gives the equations. Round-off is 1e-10 of the momentum exchanged, as everywhere.
#include <gtest/gtest.h>

#include "free_run.hpp"
#include "page.hpp"

namespace free_bodies_test {

using mpm::Vec3;
using namespace verification;

constexpr double kRoundOff = 1e-10;

/// A scene in three dimensions with one free body, and a small block in a corner that it does not meet.
std::string alone(const std::string& body, const std::string& gravity, double end) {
  return fmt::format(R"(
name: alone
geometry: solid
gravity: {}
grid: {{cell: 0.25, min: [-2, -2, -4], max: [2, 2, 2]}}
time: {{end: {}, sync: 0.01, step: 0.001}}
materials: [{{name: rubber, law: neo_hookean, density: 1000, young: 0.1 MPa, poisson: 0.3}}]
bodies: [{{name: block, material: rubber, shape: {{box: {{min: [-2, -2, -4], max: [-1.75, -1.75, -3.75]}}}}}}]
boundaries: {{all: slip}}
rigid_bodies: [{{name: free, {}}}]
)",
                     gravity, end, body);
}

// A step updates the velocity before the position: after n steps of dt the body has fallen by g dt^2 n (n + 1) / 2.
TEST(FreeBodies, FreeFallIsThatOfTheScheme) {
  mpm::Simulation simulation = run_of(
      alone("shape: {sphere: {radius: 0.1}}, free: {density: 500, velocity: [0.3, 0.2, 1]}", "[0, 0, -9.81]", 0.5));
  run_until(simulation, 0.5);
  const mpm::SolverState state = simulation.state();
  const mpm::BodyState body = simulation.bodies()[0];
  const double n = static_cast<double>(state.step.steps), dt = state.step.dt_last;
  ASSERT_NEAR(state.step.dt_min, state.step.dt_max, 1e-12);
  EXPECT_NEAR(body.twist.linear.z(), 1.0 - kFreeGravity * 0.5, 1e-12);
  EXPECT_NEAR(body.pose.position.z(), 0.5 - kFreeGravity * dt * dt * n * (n + 1.0) / 2.0, 1e-12);
  EXPECT_NEAR(body.pose.position.x(), 0.15, 1e-12);
  EXPECT_NEAR(body.pose.position.y(), 0.1, 1e-12);
  EXPECT_NEAR(body.mass, 500.0 * 4.0 / 3.0 * M_PI * 1e-3, 1e-12);
  EXPECT_LT(imbalance(simulation.free_bodies()[0]), 1e-13);
}

// Rotation about the intermediate principal axis is unstable: the body turns over repeatedly. The scheme carries the
// angular momentum from step to step; the energy varies by the square of a step's angle, 0.006 rad here.
TEST(FreeBodies, SpinningBoxKeepsItsAngularMomentum) {
  mpm::Simulation simulation = run_of(alone(
      "shape: {box: {size: [0.3, 0.2, 0.1]}}, free: {density: 1000, rotation_rate: [0.05, 6, 0.1]}", "[0, 0, 0]", 5.0));
  const mpm::FreeBodyReport start = simulation.free_bodies()[0];
  double change = 0.0, energy = 0.0, least = 1.0;
  while (seconds(simulation) < 5.0 - 1e-9) {
    simulation.advance();
    const mpm::FreeBodyReport now = simulation.free_bodies()[0];
    change = std::max(change, (now.momentum.angular - start.momentum.angular).norm());
    energy = std::max(energy, std::abs(now.kinetic / start.kinetic - 1.0));
    least = std::min(least, (simulation.bodies()[0].pose.orientation * Vec3::UnitY()).y());
  }
  EXPECT_LT(change, 1e-12 * start.momentum.angular.norm());
  EXPECT_LT(energy, 0.006 * 0.006);
  EXPECT_LT(least, -0.5);  // it has turned over
}

// Under a constant torque about a principal axis the rate is torque t / inertia, exactly so for a scheme that adds
// impulses. A force on the origin of a body whose centre of mass lies elsewhere turns it as well.
TEST(FreeBodies, WrenchGivesItsImpulse) {
  mpm::Simulation simulation = run_of(
      alone("shape: {box: {size: [0.3, 0.2, 0.1]}}, free: {mass: 2, inertia: [0.1, 0.1, 0.15]}", "[0, 0, 0]", 1.0));
  run_until(simulation, 0.2);
  EXPECT_EQ(simulation.bodies()[0].twist.angular.norm(), 0.0);
  simulation.apply_wrench(0, {{1.0, 0.0, 0.0}, {0.0, 0.0, 0.3}});
  run_until(simulation, 0.7);
  const mpm::BodyState body = simulation.bodies()[0];
  EXPECT_NEAR(body.twist.linear.x(), 1.0 * 0.5 / 2.0, 1e-12);
  EXPECT_NEAR(body.twist.angular.z(), 0.3 * 0.5 / 0.15, 1e-12);
  const mpm::FreeBodyReport report = simulation.free_bodies()[0];
  EXPECT_NEAR(report.wrench_work, report.kinetic, 1e-12);
  EXPECT_LT(imbalance(report), 1e-13);

  mpm::Simulation offset = run_of(alone(
      "shape: {box: {size: [0.3, 0.2, 0.1]}}, free: {mass: 2, inertia: [0.1, 0.1, 0.15], centre: [0, 0.05, 0], force: "
      "[1, 0, 0]}",
      "[0, 0, 0]", 0.01));
  run_until(offset, 0.01);
  // Torque about the centre: -(0, 0.05, 0) x (1, 0, 0) = (0, 0, 0.05) N m.
  EXPECT_NEAR(offset.bodies()[0].twist.angular.z(), 0.05 * 0.01 / 0.15, 1e-9);
}

/// A free body that hits a block off its centre, without gravity.
std::string collision(const std::string& method) {
  return fmt::format(R"(
name: collision
geometry: plane_strain
gravity: [0, 0]
grid: {{cell: 0.02, min: [-0.4, -0.4], max: [0.6, 0.6]}}
time: {{end: 0.2, cfl: 0.4, sync: 0.002}}
method: {}
materials: [{{name: rubber, law: neo_hookean, density: 1000, young: 1 MPa, poisson: 0.3}}]
bodies: [{{name: block, material: rubber, shape: {{box: {{min: [0, 0], max: [0.2, 0.2]}}}}}}]
rigid_bodies:
  - name: body
    shape: {{box: {{size: [0.1, 0.06]}}}}
    pose: {{position: [-0.08, 0.16], rpy: [0, 0.3, 0]}}
    friction: 0.4
    free: {{density: 300, velocity: [3, 0], rotation_rate: 2}}
)",
                     method);
}

// Without gravity there is no external force: the momentum that one loses the other gains, with any transfer. The
// impulse that the body reports from contact equals the account of contact in the material's audit, which is computed
// independently.
TEST(FreeBodies, CollisionInSpaceKeepsMomentum) {
  for (const char* method : {"{transfer: flip}", "{transfer: apic}", "{update: usf, transfer: {xpic: 2}}",
                             "{update: usl, transfer: {fmpm: 2}}"}) {
    mpm::Simulation simulation = run_of(collision(method));
    const Vec3 start = simulation.free_bodies()[0].momentum.linear + simulation.state().audit.momentum;
    run_until(simulation, 0.2);
    const mpm::SolverState state = simulation.state();
    const mpm::FreeBodyReport body = simulation.free_bodies()[0];
    const double exchanged = body.contact.linear.norm();
    EXPECT_GT(exchanged, 0.1 * start.norm()) << method;
    EXPECT_LT((body.momentum.linear + state.audit.momentum - start).norm(), kRoundOff * exchanged) << method;
    EXPECT_LT((body.contact.linear - simulation.take_contact(0).impulse).norm(), kRoundOff * exchanged) << method;
    EXPECT_LT(imbalance(body), kRoundOff) << method;
    EXPECT_LT(state.audit.residual, kRoundOff) << method;
  }
}

// Results have the same bits for any number of threads.
TEST(FreeBodies, HaveTheSameBitsForAnyNumberOfThreads) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 3}) {
    mpm::Simulation simulation = run_of(collision("{transfer: flip}"), {}, threads);
    run_until(simulation, 0.1);
    hashes.push_back(simulation.state_hash());
  }
  EXPECT_EQ(hashes[1], hashes[0]);
  EXPECT_EQ(hashes[2], hashes[0]);
}

// A commanded velocity sets only the directions in which a body is not free: here the rotation; translation is free.
TEST(FreeBodies, CommandsReachWhatIsTold) {
  const std::string text =
      alone("shape: {sphere: {radius: 0.1}}, free: {density: 500, axes: [x, y, z]}", "[0, 0, -9.81]", 0.5);
  mpm::Simulation simulation = run_of(text);
  simulation.command_velocity(0, {{5.0, 5.0, 5.0}, {0.0, 0.0, 2.0}});
  run_until(simulation, 0.1);
  const mpm::BodyState body = simulation.bodies()[0];
  EXPECT_EQ(body.twist.angular.z(), 2.0);
  EXPECT_NEAR(body.twist.linear.z(), -0.981, 1e-12);
  EXPECT_EQ(body.twist.linear.x(), 0.0);
  EXPECT_EQ(body.drive, mpm::Drive::velocity);
  // The drive gave the spin: 2/5 m r^2 times the rate.
  const mpm::FreeBodyReport report = simulation.free_bodies()[0];
  EXPECT_NEAR(report.drive.angular.z(), 0.4 * body.mass * 0.01 * 2.0, 1e-12);
  EXPECT_LT(imbalance(report), 1e-13);
  EXPECT_THROW(simulation.command_pose(0, body.pose, simulation.time() + 10'000'000), mpm::RigidError);

  mpm::Simulation whole = run_of(alone("shape: {sphere: {radius: 0.1}}, free: {density: 500}", "[0, 0, 0]", 0.5));
  EXPECT_THROW(whole.command_velocity(0, {}), mpm::RigidError);
  EXPECT_THROW(whole.apply_wrench(0, {{NAN, 0.0, 0.0}, {}}), mpm::RigidError);
  mpm::Simulation prescribed = run_of(alone("shape: {sphere: {radius: 0.1}}", "[0, 0, 0]", 0.5));
  EXPECT_THROW(prescribed.apply_wrench(0, {}), mpm::RigidError);
}

}  // namespace free_bodies_test
