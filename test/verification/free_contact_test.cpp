// Free rigid bodies on material: a ball that bounces, a block that floats, bodies much lighter than what they lie on, a
// wheel at rest. doc/free_bodies.md has what is solved.
#include <gtest/gtest.h>

#include "free_run.hpp"
#include "page.hpp"

namespace {

using namespace verification;

// The energy that was lost in meeting is counted apart from it; what is left over is what the transfer to the particles
// lets go (FLIP calms the ringing block) and half a step's fall.
TEST(FreeBodies, BallBouncesOnABlock) {
  constexpr double kHeight = 0.1;
  mpm::Simulation simulation = run_of(R"(
name: ball
geometry: plane_strain
gravity: [0, -9.81]
grid: {cell: 0.02, min: [-0.4, -0.2], max: [0.4, 0.4]}
time: {end: 0.3, cfl: 0.4, sync: 0.002}
method: {update: usavg, transfer: flip}
materials: [{name: rubber, law: neo_hookean, density: 1000, young: 1 MPa, poisson: 0.3}]
bodies: [{name: block, material: rubber, shape: {box: {min: [-0.4, -0.2], max: [0.4, 0]}}}]
boundaries: {x_min: slip, x_max: slip, z_min: fixed}
rigid_bodies:
  - {name: ball, shape: {sphere: {radius: 0.06}}, pose: {position: [0, 0.16]}, friction: 0.3, free: {density: 1000}}
)");
  const double start = accounted(simulation.state().energy);
  const double fall = simulation.free_bodies()[0].mass * kGravity * kHeight;
  double top = 0.0, worst_gain = 0.0;
  bool bounced = false;
  while (seconds(simulation) < 0.3 - 1e-9) {
    simulation.advance();
    const mpm::BodyState ball = simulation.bodies()[0];
    bounced = bounced || ball.twist.linear.z() > 0.0;
    if (bounced) top = std::max(top, ball.pose.position.z() - 0.06);
    worst_gain = std::max(worst_gain, accounted(simulation.state().energy) - start);
  }
  const mpm::SolverState state = simulation.state();
  const mpm::FreeBodyReport ball = simulation.free_bodies()[0];
  EXPECT_LT(state.audit.residual, 1e-10);
  EXPECT_LT(imbalance(ball), 1e-10);
  EXPECT_GT(top, 0.1 * kHeight);
  EXPECT_LT(top, kHeight);
  EXPECT_LT(worst_gain, 0.01 * fall);
  EXPECT_GT(state.energy.free_loss, 0.0);
  Page page("contact", "free_ball", "A ball that falls on an elastic block");
  page.problem(
          "A rigid disc of 60 mm radius, as heavy as rubber, falls 0.1 m onto a block of it (E = 1 MPa) and bounces.")
      .exact("The energy of disc and block, with what contact and friction took, stays.", "balance of energy");
  page.near("energy accounted for, over that of the fall", 1.0 + (accounted(state.energy) - start) / fall, 1.0, 0.05,
            "1");
  page.report("rebound height", top, "m");
  page.report("lost where they meet, over that of the fall", state.energy.free_loss / fall, "1");
  page.meaning(
      "What is lost in meeting is the blow itself: a surface node stops at once. The rest of what the disc does not "
      "get "
      "back is in the block, which rings; FLIP lets a part of that go, which nothing accounts for.");
}

// The block's under side is a third as deep in a closed tank as the level tells: the water that it displaces lifts the
// level. Water is stiff enough for 0.15 % of compression.
TEST(FreeBodies, BlockFloatsAtArchimedesDepth) {
  constexpr double kDepth = 0.4, kLength = 0.4, kHeight = 0.24, kDensity = 500.0;
  mpm::Simulation simulation = run_of(fmt::format(R"(
name: float
geometry: plane_strain
gravity: [0, -9.81]
grid: {{cell: 0.04, min: [-0.52, 0], max: [0.52, 0.8]}}
time: {{end: 4, cfl: 0.4, sync: 0.01}}
method: {{update: usavg, transfer: {{flip: 0.95}}}}
materials: [{{name: water, law: newtonian_fluid, density: 1000, bulk_modulus: 1 MPa, viscosity: 1}}]
bodies:
  - {{name: water, material: water, shape: {{box: {{min: [-0.52, 0], max: [0.52, {}]}}}}, cut_out: [block],
     initial: geostatic}}
boundaries: {{x_min: slip, x_max: slip, z_min: slip}}
rigid_bodies:
  - {{name: block, shape: {{box: {{size: [{}, {}]}}}}, pose: {{position: [0, 0.42]}}, friction: 0, free: {{density: {}}}}}
)",
                                                  kDepth, kLength, kHeight, kDensity));
  const double water = static_cast<double>(field(simulation, "x").size()) * 0.02 * 0.02;
  run_until(simulation, 3.0);
  double bottom = 0.0;
  int count = 0;
  while (seconds(simulation) < 4.0 - 1e-9) {
    simulation.advance();
    bottom += simulation.bodies()[0].pose.position.z() - 0.5 * kHeight;
    ++count;
  }
  bottom /= count;
  // Level: (water + length * depth) / width of the tank; depth = level - bottom.
  const double tank = 1.04;
  const double depth = (water / tank - bottom) / (1.0 - kLength / tank);
  Page page("contact", "free_float", "A block that floats");
  page.problem("A block half as dense as water, 0.4 m by 0.24 m, floats in a tank; the mean of the fourth second.")
      .exact("It lies as deep as its weight displaces water: half its height.", "Archimedes");
  page.near("depth of its under side", depth, kHeight * kDensity / 1000.0, 0.05, "m");
  EXPECT_LT(simulation.state().audit.residual, 1e-10);
  EXPECT_LT(imbalance(simulation.free_bodies()[0]), 1e-10);
}

/// A slab over rubber or soil, and what it does in `end` [s].
mpm::Simulation slab(const std::string& material, const std::string& initial, double density, double height) {
  return run_of(fmt::format(R"(
name: slab
geometry: plane_strain
gravity: [0, -9.81]
grid: {{cell: 0.04, min: [-0.4, -0.2], max: [0.4, 0.6]}}
time: {{end: 0.5, cfl: 0.4, sync: 0.002}}
method: {{update: usavg, transfer: {{flip: 0.998}}}}
materials: [{}]
bodies: [{{name: bed, material: bed, shape: {{box: {{min: [-0.4, -0.2], max: [0.4, 0]}}}}, initial: {}}}]
boundaries: {{x_min: slip, x_max: slip, z_min: fixed}}
rigid_bodies:
  - {{name: slab, shape: {{box: {{size: [0.2, 0.1]}}}}, pose: {{position: [0.003, {}]}}, friction: 0.5,
     free: {{density: {}}}}}
)",
                            material, initial, 0.05 + height, density));
}

// A hundredth and a thousandth of the material's density, dropped by half its height. Stable: it never goes faster than
// by the fall and never as high again, and in the end lies on the surface within a tenth of a cell.
TEST(FreeBodies, LightBodiesLieStill) {
  const std::string soil =
      "{name: bed, law: drucker_prager, match: plane_strain, density: 1600, young: 1 MPa, poisson: 0.3, "
      "friction_angle: "
      "30 deg, cohesion: 500 Pa}";
  const std::string rubber = "{name: bed, law: neo_hookean, density: 1000, young: 1 MPa, poisson: 0.3}";
  constexpr double kFall = 0.05, kCell = 0.04;
  for (const bool elastic : {false, true}) {
    for (const double part : {0.01, 0.001}) {
      const double density = part * (elastic ? 1000.0 : 1600.0);
      mpm::Simulation simulation = slab(elastic ? rubber : soil, "geostatic", density, kFall);
      const std::string what = fmt::format("{}, {} of its density", elastic ? "rubber" : "soil", part);
      double fastest = 0.0, highest = 0.0;
      while (seconds(simulation) < 0.5 - 1e-9) {
        simulation.advance();
        const mpm::BodyState body = simulation.bodies()[0];
        fastest = std::max(fastest, body.twist.linear.norm());
        if (seconds(simulation) > 0.15) highest = std::max(highest, body.pose.position.z() - 0.05);
      }
      const mpm::BodyState body = simulation.bodies()[0];
      EXPECT_LT(fastest, 1.05 * std::sqrt(2.0 * kGravity * kFall)) << what;
      EXPECT_LT(highest, kFall) << what;
      EXPECT_NEAR(body.pose.position.z(), 0.05, 0.1 * kCell) << what;
      EXPECT_NEAR(body.pose.position.x(), 0.003, 0.1 * kCell) << what;
      EXPECT_LT(simulation.state().audit.residual, 1e-10) << what;
      EXPECT_LT(imbalance(simulation.free_bodies()[0]), 1e-10) << what;
    }
  }
}

// Let down gently on sand that is at rest under its own weight; once it has settled it neither creeps nor spins up: in
// the second half it moves by less than a thousandth of its radius.
TEST(FreeBodies, WheelAtRestStays) {
  mpm::Simulation simulation = run_of(R"(
name: wheel
geometry: plane_strain
gravity: [0, -9.81]
grid: {cell: 0.04, min: [-0.4, -0.2], max: [0.4, 0.6]}
time: {end: 1, cfl: 0.4, sync: 0.005}
method: {update: usavg, transfer: {flip: 0.99}}
materials: [{name: bed, law: drucker_prager, match: plane_strain, density: 1600, young: 1 MPa, poisson: 0.3,
  friction_angle: 30 deg, cohesion: 500 Pa}]
bodies: [{name: bed, material: bed, shape: {box: {min: [-0.4, -0.2], max: [0.4, 0]}}, initial: geostatic}]
boundaries: {x_min: slip, x_max: slip, z_min: fixed}
rigid_bodies:
  - {name: wheel, shape: {sphere: {radius: 0.15}}, pose: {position: [0.007, 0.151]}, friction: 0.5, free: {density: 400}}
)");
  run_until(simulation, 0.5);
  const mpm::Pose settled = simulation.bodies()[0].pose;
  run_until(simulation, 1.0);
  const mpm::Pose later = simulation.bodies()[0].pose;
  EXPECT_LT((later.position - settled.position).norm(), 1e-3 * 0.15);
  EXPECT_LT(later.orientation.angularDistance(settled.orientation), 1e-3);
}

}  // namespace
