// Free rigid bodies on material: a ball that bounces, a block that floats, bodies much lighter than the material below
// them, a wheel at rest. doc/free_bodies.md gives the equations.
#include <gtest/gtest.h>

#include <string>

#include "free_run.hpp"
#include "page.hpp"

namespace free_contact_test {

using namespace verification;

/// Energies and impulse at a sync point.
struct Bounce {
  double missing, block, ball;  // energy not accounted for since the start, of the material, of the free body [J]
  mpm::Vec3 given;              // impulse of contact on the ball [N s]
  std::uint64_t steps;
};

// The energy that is lost at impact has an account of its own. The energy without an account has three parts: the error
// of the scheme in free fall, which is known exactly; the loss by FLIP while the block vibrates after contact; and a
// rest while they touch. There is no theory for this rest and for the sum, so their limits bound measured values. The
// rest is 0.5 % here, 1.6 % with a quarter of the step, and 2 % of gain with cells of half the size.
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
  const double fall = simulation.bodies()[0].mass * kFreeGravity * kHeight;
  const auto look = [&] {
    const mpm::SolverState now = simulation.state();
    return Bounce{start - accounted(now.energy), now.energy.total(),
                  now.energy.of("free_kinetic") + now.energy.of("free_potential"),
                  simulation.free_bodies()[0].contact.linear, now.step.steps};
  };
  std::vector<Bounce> seen = {look()};
  double top = 0.0, most = 0.0;
  std::size_t touch = 0, part = 0;  // the last sync point before contact, and the first after it
  while (seconds(simulation) < 0.3 - 1e-9) {
    simulation.advance();
    seen.push_back(look());
    const std::size_t now = seen.size() - 1;
    if (seen[now].given != seen[now - 1].given) {
      if (touch == 0) touch = now - 1;
      part = now;
    }
    if (part > 0) top = std::max(top, simulation.bodies()[0].pose.position.z() - 0.06);
    most = std::max(most, -seen[now].missing);
  }
  const mpm::SolverState state = simulation.state();
  const mpm::FreeBodyReport ball = simulation.free_bodies()[0];
  EXPECT_LT(state.audit.residual, 1e-10);
  EXPECT_LT(imbalance(ball), 1e-10);
  EXPECT_LT(most, 0.01 * fall);  // gain at any time: also a bound on a measured value
  EXPECT_GT(state.energy.of("free_loss"), 0.0);
  EXPECT_LT(part, seen.size() - 50);  // the ball has left the block
  // In free flight a step loses m g^2 dt^2 / 2, since the position follows from the velocity at the end of the step.
  // The rest is round-off of sums.
  double flight = 0.0;
  for (std::size_t i = part + 1; i < seen.size(); ++i) {
    flight += 0.5 * ball.mass * kFreeGravity * kFreeGravity * 0.002 * 0.002 /
              static_cast<double>(seen[i].steps - seen[i - 1].steps);
  }
  EXPECT_NEAR(seen[part].ball - seen.back().ball, flight, 1e-10 * fall);
  const double together = seen[part].missing - seen[touch].missing;
  const double alone = seen.back().missing - seen[part].missing - flight;
  // The energy left for the rise is that of the fall, less the losses and the block's energy when they separate.
  const double left = fall - state.energy.of("free_loss") - state.energy.of("friction") -
                      (seen[part].block - seen[touch].block) + 0.01 * fall;
  Page page("contact", "free_ball", "A ball that falls on an elastic block");
  page.problem(
          "A rigid disc of 60 mm radius, as heavy as rubber, falls 0.1 m onto a block of it (E = 1 MPa) and bounces.")
      .exact("The energy of disc and block, plus the energy dissipated by contact and friction, is constant.",
             "balance of energy");
  page.near("energy accounted for, over that of the fall", 1.0 - seen.back().missing / fall, 1.0, 0.05, "1");
  page.near_absolute("not accounted for while they touch, over that of the fall", together / fall, 0.0, 0.02, "1");
  page.report("let go by FLIP while the block rings alone, over that of the fall", alone / fall, "1");
  page.report("lost where they meet, over that of the fall", state.energy.of("free_loss") / fall, "1");
  page.below("rebound height; most that the balance of energy leaves", top, left / (ball.mass * kFreeGravity), "m");
  page.meaning(
      "The loss at impact is that of the surface nodes, which stop at once. The rest of the energy that the disc "
      "does not regain is in the block's vibration, of which FLIP loses a part without an account. The limits on "
      "energy without an account, 5 % in all and 2 % while they touch, bound measured values; they are not derived.");
}

// In a closed tank the displaced water lifts the level. The block is nine cells deep in the water. The water's surface
// beside a body is resolved to a third of a cell, 4 % of that; a block three cells deep lies 13 % too high. The block
// is kept upright, and the water is compressed by 0.3 %.
TEST(FreeBodies, BlockFloatsAtArchimedesDepth) {
  constexpr double kTank = 1.04, kLength = 0.4, kHeight = 0.6, kDensity = 600.0;
  mpm::Simulation simulation = run_of(fmt::format(R"(
name: float
geometry: plane_strain
gravity: [0, -9.81]
grid: {{cell: 0.04, min: [-0.52, 0], max: [0.52, 1.2]}}
time: {{end: 2.5, cfl: 0.4, sync: 0.01}}
method: {{update: usavg, transfer: {{flip: 0.95}}}}
materials: [{{name: water, law: newtonian_fluid, density: 1000, bulk_modulus: 1 MPa, viscosity: 1}}]
bodies:
  - {{name: water, material: water, shape: {{box: {{min: [-0.52, 0], max: [0.52, 0.6]}}}}, cut_out: [block]}}
boundaries: {{x_min: slip, x_max: slip, z_min: slip}}
rigid_bodies:
  - {{name: block, shape: {{box: {{size: [{}, {}]}}}}, pose: {{position: [0, 0.57]}}, friction: 0,
     free: {{density: {}, axes: [x, z]}}}}
)",
                                                  kLength, kHeight, kDensity));
  const double water = static_cast<double>(field(simulation, "x").size()) * 0.02 * 0.02;
  run_until(simulation, 1.5);
  double bottom = 0.0;
  int count = 0;
  while (seconds(simulation) < 2.5 - 1e-9) {
    simulation.advance();
    bottom += simulation.bodies()[0].pose.position.z() - 0.5 * kHeight;
    ++count;
  }
  bottom /= count;
  // Level: (water + length * depth) / width of the tank; depth = level - bottom.
  const double depth = (water / kTank - bottom) / (1.0 - kLength / kTank);
  Page page("contact", "free_float", "A block that floats");
  page.problem(
          "A block of 600 kg/m^3, 0.4 m wide and 0.6 m high, floats upright in a tank of water; cells of 40 mm. Mean "
          "from "
          "1.5 s to 2.5 s.")
      .exact("It lies as deep as its weight displaces water.", "Archimedes");
  page.near("depth of its under side", depth, kHeight * kDensity / 1000.0, 0.05, "m");
  EXPECT_LT(simulation.state().audit.residual, 1e-10);
  EXPECT_LT(imbalance(simulation.free_bodies()[0]), 1e-10);
}

/// A light slab above rubber or soil.
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

// A slab of a hundredth and of a thousandth of the material's density is dropped by half its height. Stable means that
// it is never faster than by the fall, never rises as high again, and in the end lies on the surface within a tenth of
// a cell. Nothing gives slab and bed energy: together they never have more than at the start.
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
      double fastest = 0.0, highest = 0.0, most = 0.0;
      const double start = simulation.state().energy.whole();
      while (seconds(simulation) < 0.5 - 1e-9) {
        simulation.advance();
        most = std::max(most, simulation.state().energy.whole() - start);
        const mpm::BodyState body = simulation.bodies()[0];
        fastest = std::max(fastest, body.twist.linear.norm());
        if (seconds(simulation) > 0.15) highest = std::max(highest, body.pose.position.z() - 0.05);
      }
      const mpm::BodyState body = simulation.bodies()[0];
      EXPECT_LT(fastest, 1.05 * std::sqrt(2.0 * kFreeGravity * kFall)) << what;
      EXPECT_LT(highest, kFall) << what;
      EXPECT_LT(most, 1e-3 * simulation.bodies()[0].mass * kFreeGravity * kFall) << what;
      EXPECT_NEAR(body.pose.position.z(), 0.05, 0.1 * kCell) << what;
      EXPECT_NEAR(body.pose.position.x(), 0.003, 0.1 * kCell) << what;
      EXPECT_LT(simulation.state().audit.residual, 1e-10) << what;
      EXPECT_LT(imbalance(simulation.free_bodies()[0]), 1e-10) << what;
    }
  }
}

// A wheel that is set down on soil at rest under its own weight rolls into its own dimple and rocks there for some
// seconds, as only the soil damps it. It neither creeps nor spins up: from one second to the next the rocking
// decreases, and its mean position moves by less than a hundredth of the radius.
TEST(FreeBodies, WheelAtRestStays) {
  mpm::Simulation simulation = run_of(R"(
name: wheel
geometry: plane_strain
gravity: [0, -9.81]
grid: {cell: 0.04, min: [-0.4, -0.2], max: [0.4, 0.6]}
time: {end: 2, cfl: 0.4, sync: 0.005}
method: {update: usavg, transfer: {flip: 0.99}}
materials: [{name: bed, law: drucker_prager, match: plane_strain, density: 1600, young: 1 MPa, poisson: 0.3,
  friction_angle: 30 deg, cohesion: 500 Pa}]
bodies: [{name: bed, material: bed, shape: {box: {min: [-0.4, -0.2], max: [0.4, 0]}}, initial: geostatic}]
boundaries: {x_min: slip, x_max: slip, z_min: fixed}
rigid_bodies:
  - {name: wheel, shape: {sphere: {radius: 0.15}}, pose: {position: [0.007, 0.151]}, friction: 0.5, free: {density: 400}}
)");
  struct Rocking {
    double middle = 0.0, swing = 0.0;  // [m]
  };
  const auto rocking_until = [&](double end) {
    std::vector<double> places;
    while (seconds(simulation) < end - 1e-9) {
      simulation.advance();
      places.push_back(simulation.bodies()[0].pose.position.x());
    }
    const auto [least, most] = std::minmax_element(places.begin(), places.end());
    return Rocking{0.5 * (*least + *most), *most - *least};
  };
  run_until(simulation, 0.3);
  const Rocking first = rocking_until(1.1), second = rocking_until(1.9);  // its period is 0.6 s
  EXPECT_LT(second.swing, first.swing);
  EXPECT_LT(std::abs(second.middle - first.middle), 0.01 * 0.15);
}

// A body that is free and touches nothing does not spoil the force on a tool whose motion is prescribed: with it the
// sweeps of contact end by another rule. 0.7 s.
TEST(FreeBodies, ABodyInTheAirLeavesTheForceOnAToolAsItIs) {
  const std::string tool = R"(
name: plate
geometry: plane_strain
gravity: [0, -9.81]
grid: {cell: 0.02, min: [0, 0], max: [1.2, 1]}
time: {end: 0.3, cfl: 0.5, sync: 5 ms}
materials:
  - {name: sand, law: drucker_prager, density: 1600, young: 1 MPa, poisson: 0.3, friction_angle: 34 deg, cohesion: 500 Pa}
bodies: [{name: bed, material: sand, shape: {box: {min: [0, 0], max: [1.2, 0.3]}}, initial: geostatic}]
boundaries: {x_min: slip, x_max: slip, z_min: slip}
rigid_bodies:
  - name: plate
    shape: {box: {size: [0.2, 0.1]}}
    pose: {position: [0.4, 0.352]}
    friction: 0.5
    motion: {velocity: [0.02, -0.05]}
)";
  const auto impulse_of = [](const std::string& scene) {
    mpm::Simulation simulation = run_of(scene);
    run_until(simulation, 0.3);
    return simulation.take_contact(0).impulse;
  };
  const mpm::Vec3 alone = impulse_of(tool);
  const mpm::Vec3 beside = impulse_of(
      tool + "  - {name: ball, shape: {sphere: {radius: 0.05}}, pose: {position: [0.9, 0.9]}, free: {mass: 1 kg}}\n");
  EXPECT_GT(alone.z(), 100.0);
  EXPECT_LT((beside - alone).norm(), 0.01 * alone.norm());
}

}  // namespace free_contact_test
