// Rigid bodies in simulations whose steps a device takes: contact at points and at nodes, prescribed, commanded and
// free bodies, as on the processor. Cost: 3 s.
#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "../unit/checkpoint_run.hpp"
#include "gpu_runs.hpp"
#include "gpu_scenes.hpp"
#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm/rigid/surface.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/state_set.hpp"

namespace gpu_contact_test {

using namespace gpu_runs;
using mpm::Function;
using mpm::Vec3;

/// A ball is pressed askew into an elastic block on a floor.
SimulationDefinition pressed_block(mpm::Precision precision) {
  SimulationDefinition d = gpu_scenes::falling_block(precision);
  d.bodies.front() = gpu_scenes::block(d, "block", {3.0, 3.0, 0.0}, {7.0, 7.0, 4.0}, Vec3::Zero());
  d.rigid_bodies = {gpu_scenes::tool("ball", mpm::make_sphere(0.2), {0.51, 0.48, 0.615}, {0.3, 0.1, -0.8})};
  return d;
}
/// A wide box pushes the foot of a column of sand, whose cells share a stress; strain in halves.
SimulationDefinition pushed_column(mpm::Precision precision) {
  SimulationDefinition d = gpu_scenes::column_usavg(precision);
  d.method.average_stress = true;
  d.bodies.front() = gpu_scenes::block(d, "sand", {4.0, 0.0, 0.0}, {10.0, 0.0, 8.0}, Vec3::Zero());
  d.rigid_bodies = {gpu_scenes::tool("plate", mpm::make_box({0.35, 1.0, 0.5}), {0.20, 0.0, 0.26}, {1.0, 0.0, 0.05})};
  return d;
}
SimulationDefinition at_nodes(SimulationDefinition d) {
  d.contact.method = mpm::ContactMethod::nodes;
  return d;
}
SimulationDefinition block_at_nodes(mpm::Precision precision) { return at_nodes(pressed_block(precision)); }
SimulationDefinition column_at_nodes(mpm::Precision precision) { return at_nodes(pushed_column(precision)); }

/// A plate presses a ball of clay, whose surface cuts the places of particles: they have masses and reaches of their
/// own.
SimulationDefinition pressed_ball(mpm::Precision precision) {
  const mpm::Scene ball = mpm::parse_scene(R"(
grid: {cell: 0.1, min: [0, 0, 0], max: [1.2, 1.2, 1.2]}
gravity: [0, 0, -9.81]
method: {update: usavg, average_stress: true}
materials: [{name: clay, law: j2_plasticity, density: 1800, young: 1 MPa, poisson: 0.4, yield_stress: 5 kPa}]
bodies: [{name: ball, material: clay, shape: {sphere: {center: [0.61, 0.58, 0.305], radius: 0.3}}}]
boundaries: {all: slip, z_min: fixed}
)",
                                           "ball.yaml");
  SimulationDefinition d = mpm::build(ball);
  d.method.precision = precision;
  d.contact.method = mpm::ContactMethod::nodes;
  d.rigid_bodies = {gpu_scenes::tool("plate", mpm::make_box({0.7, 0.7, 0.35}), {0.6, 0.6, 0.79}, {0.2, 0.0, -1.0})};
  return d;
}
SimulationDefinition ball_at_points(mpm::Precision precision) {
  SimulationDefinition d = pressed_ball(precision);
  d.contact.method = mpm::ContactMethod::points;
  return d;
}

/// A heavy ball falls on the block, free to turn.
SimulationDefinition struck_block(mpm::Precision precision) {
  SimulationDefinition d = pressed_block(precision);
  gpu_scenes::let_fall(d.rigid_bodies.front());
  return d;
}
SimulationDefinition struck_with_fmpm(mpm::Precision precision) {
  SimulationDefinition d = struck_block(precision);
  d.method.transfer = {mpm::TransferKind::fmpm, 0.0, 2};
  return d;
}
SimulationDefinition pushed_with_xpic(mpm::Precision precision) {
  SimulationDefinition d = column_at_nodes(precision);
  d.method.transfer = {mpm::TransferKind::xpic, 0.0, 3};
  d.time.cfl = 0.4;
  return d;
}
SimulationDefinition pushed_with_splines(mpm::Precision precision) {
  SimulationDefinition d = pushed_column(precision);
  d.method.shape = mpm::ShapeKind::bspline3;
  d.method.update = mpm::UpdateScheme::usl;
  return d;
}

// Two features at once: contact beside mixtures, damping, loads, periodic axes and particles that leave.
SimulationDefinition pushed_mixture(mpm::Precision precision) {
  SimulationDefinition d = column_at_nodes(precision);
  d.method.transfer = gpu_scenes::column_mixture(precision).method.transfer;
  return d;
}
SimulationDefinition pressed_with_damping(mpm::Precision precision) {
  SimulationDefinition d = block_at_nodes(precision);
  d.method.damping = gpu_scenes::block_damped(precision).method.damping;
  d.method.update = mpm::UpdateScheme::usavg;
  return d;
}
SimulationDefinition pressed_under_load(mpm::Precision precision) {
  SimulationDefinition d = block_at_nodes(precision);
  mpm::BodyForceDefinition wind;
  wind.acceleration[0] = Function::parse("4 + 100 * t");
  d.body_forces = {wind};
  return d;
}
/// A plate that is endless along the periodic axis presses a layer that goes around.
SimulationDefinition pressed_layer(mpm::Precision precision) {
  SimulationDefinition d = gpu_scenes::column_usavg(precision);
  d.grid.max.x() = 8.0 * d.grid.cell.x();
  d.walls[0].kind = d.walls[1].kind = mpm::WallKind::periodic;
  d.method.average_stress = true;
  d.contact.method = mpm::ContactMethod::nodes;
  d.bodies.front() = gpu_scenes::block(d, "sand", {0.0, 0.0, 0.0}, {8.0, 0.0, 6.0}, {4.0, 0.0, 0.0});
  const double endless = std::numeric_limits<double>::infinity();
  d.rigid_bodies = {gpu_scenes::tool("plate", mpm::make_box({endless, 1.0, 0.5}), {0.4, 0.0, 0.86}, {1.0, 0.0, -0.5})};
  return d;
}

void expect_near(const Vec3& a, const Vec3& b, double bound, const char* what) {
  EXPECT_LT((a - b).norm(), bound) << what << ": " << a.transpose() << ", " << b.transpose();
}

/// All that contact reports of a body.
void expect_contact_alike(Simulation& here, Simulation& there, double bound) {
  const mpm::ContactReport a = here.take_contact(0), b = there.take_contact(0);
  const double force = a.mean.force.norm(), impulse = a.impulse.norm();
  EXPECT_GT(force, 0.0);
  EXPECT_GT(a.nodes, 0);
  EXPECT_EQ(a.nodes, b.nodes);
  expect_near(a.mean.force, b.mean.force, bound * force, "force");
  expect_near(a.mean.torque, b.mean.torque, bound * force, "torque");  // arms are shorter than a metre
  expect_near(a.peak.force, b.peak.force, bound * a.peak.force.norm(), "peak");
  expect_near(a.impulse, b.impulse, bound * impulse, "impulse");
  expect_near(a.friction, b.friction, bound * force, "friction");
  expect_near(a.arm, b.arm, bound, "arm");
  EXPECT_NEAR(a.area, b.area, bound * a.area);
  EXPECT_NEAR(a.friction_energy, b.friction_energy, bound * (std::abs(a.friction_energy) + impulse));  // at 1 m/s
  const mpm::BodyState at = here.bodies().front(), to = there.bodies().front();
  expect_near(at.pose.position, to.pose.position, bound, "place");
  expect_near(at.twist.linear, to.twist.linear, bound, "velocity");
  expect_near(at.twist.angular, to.twist.angular, 10.0 * bound, "rotation");
}

void expect_touch_alike(SimulationDefinition (*of)(mpm::Precision), double bound = kRoundOff, int periods = kPeriods) {
  Simulation here(scene(of), options(false)), there(scene(of), options(true));
  advance(here, periods);
  advance(there, periods);
  expect_alike(here, there, bound);
  expect_contact_alike(here, there, bound);
}

// Sweeps over points end at a thousandth of the largest velocity, and what is left depends on the order of the points.
// That is the order in which particles lie, so where these leave their cells it depends on when they are sorted, which
// a device does more often. A blow at a fifth of the speed of waves, of which ten sweeps solve less, differs by 1 %.
constexpr double kSweeps = 1e-3;

TEST(GpuContact, BlockAtPoints) { expect_touch_alike(pressed_block); }
TEST(GpuContact, BlockAtNodes) { expect_touch_alike(block_at_nodes); }
TEST(GpuContact, ColumnAtPoints) { expect_touch_alike(pushed_column, kSweeps); }
TEST(GpuContact, ColumnAtNodes) { expect_touch_alike(column_at_nodes); }
TEST(GpuContact, CutBallAtNodes) {
  ASSERT_FALSE(pressed_ball(mpm::Precision::float64).bodies.front().parts.empty());
  expect_touch_alike(pressed_ball);
}
// Compared until particles leave their cells.
TEST(GpuContact, CutBallAtPoints) { expect_touch_alike(ball_at_points, kRoundOff, 3); }
TEST(GpuContact, FreeBallOnBlock) { expect_touch_alike(struck_block); }
TEST(GpuContact, FreeBallWithFmpm) { expect_touch_alike(struck_with_fmpm); }
TEST(GpuContact, ColumnWithXpic) { expect_touch_alike(pushed_with_xpic); }
TEST(GpuContact, ColumnWithSplines) { expect_touch_alike(pushed_with_splines, kSweeps); }

TEST(GpuContact, ColumnWithMixture) { expect_touch_alike(pushed_mixture); }
TEST(GpuContact, BlockWithDamping) { expect_touch_alike(pressed_with_damping); }
TEST(GpuContact, BlockUnderLoad) { expect_touch_alike(pressed_under_load); }

// Places along a periodic axis are compared on its circle elsewhere.
TEST(GpuContact, PeriodicLayer) {
  Simulation here(scene(pressed_layer), options(false)), there(scene(pressed_layer), options(true));
  advance(here, kPeriods);
  advance(there, kPeriods);
  expect_sums_alike(here, there);
  expect_contact_alike(here, there, kRoundOff);
}

TEST(GpuContact, BlockInSingle) {
  SimulationDefinition d = scene(block_at_nodes);
  d.method.precision = mpm::Precision::float32;
  Simulation here(d, options(false)), there(d, options(true));
  advance(here, kPeriods);
  advance(there, kPeriods);
  expect_sums_alike(here, there, 1e-5);
  EXPECT_NEAR(here.take_contact(0).impulse.z(), there.take_contact(0).impulse.z(),
              1e-5 * here.take_contact(0).impulse.norm());
}

// A body is set beside where the material was, and not where it is: the device alone knows that it has moved on.
TEST(GpuContact, BodiesAreSetWhereMaterialIsNot) {
  SimulationDefinition d = scene(block_at_nodes);
  d.walls[4].kind = mpm::WallKind::slip;
  for (Vec3& velocity : d.bodies.front().velocities) velocity = {4.0, 0.0, 0.0};
  d.rigid_bodies.front().pose.position = {0.9, 0.9, 0.9};
  d.rigid_bodies.front().velocity = {};
  Simulation there(d, options(true));
  advance(there, kPeriods);  // 16 cm
  mpm::StateSet into, beside;
  into.name = beside.name = "ball";
  into.pose = mpm::Pose{{0.75, 0.5, 0.3}, mpm::Quat::Identity()};
  beside.pose = mpm::Pose{{0.24, 0.5, 0.3}, mpm::Quat::Identity()};
  EXPECT_THROW(there.set_state(into), mpm::RigidError);
  there.set_state(beside);
  there.advance();
  EXPECT_NEAR(there.bodies().front().pose.position.x(), 0.24, 1e-12);
}

// A tool that starts far away, comes and goes by command; then nothing is near it.
TEST(GpuContact, FollowsCommands) {
  SimulationDefinition d = scene(pressed_block);
  d.rigid_bodies.front().pose.position.z() = 0.65;
  d.rigid_bodies.front().velocity = {};
  Simulation here(d, options(false)), there(d, options(true));
  for (Simulation* one : {&here, &there}) {
    one->command_velocity(0, {{0.2, 0.0, -3.0}, Vec3::Zero()});
    advance(*one, 4);
    one->command_velocity(0, {Vec3::Zero(), {0.0, 0.0, 3.0}});
    advance(*one, 2);
  }
  expect_alike(here, there, kSweeps);
  expect_contact_alike(here, there, kSweeps);
  for (Simulation* one : {&here, &there}) {
    one->command_velocity(0, {{0.0, 0.0, 8.0}, Vec3::Zero()});
    advance(*one, 6);
    EXPECT_EQ(one->take_contact(0).nodes, 0);
  }
  expect_alike(here, there, kSweeps);
}

// Half of the run on one, half on the other, either way, while the tool presses: what contact remembers goes along.
TEST(GpuContact, CheckpointsGoFromOneToTheOther) {
  const mpm::test::Folder folder;
  Simulation whole(scene(column_at_nodes), options(false));
  advance(whole, kPeriods);
  for (const bool begins_on_device : {true, false}) {
    const std::string file = folder.file(begins_on_device ? "from_device.h5" : "to_device.h5");
    Simulation first(scene(column_at_nodes), options(begins_on_device));
    advance(first, kPeriods / 2);
    mpm::save_checkpoint(file, first, {});
    Simulation second(scene(column_at_nodes), options(!begins_on_device));
    mpm::load_checkpoint(file, second, "");
    EXPECT_EQ(first.state_hash(), second.state_hash());
    advance(second, kPeriods / 2);
    expect_alike(whole, second);
    advance(first, kPeriods / 2);  // a checkpoint changes nothing that follows
    expect_alike(whole, first);
  }
}

// Memory of contact, and the nodes near bodies, are those of a run that was not interrupted.
TEST(GpuContact, ResumesToTheBit) {
  for (const auto of : {column_at_nodes, pushed_column, pushed_mixture, struck_block}) {
    expect_resumes(
        scene(of), [](Simulation&) {},
        [](Simulation& whole, Simulation& second) {
          EXPECT_EQ(whole.take_contact(0).impulse, second.take_contact(0).impulse);
        });
  }
}
}  // namespace gpu_contact_test
