// Rigid bodies that meet each other and walls: against Coulomb's law, the moments of a rolling sphere, the momentum of
// an impact. Cost: 14 s.
#include <gtest/gtest.h>

#include "free_run.hpp"
#include "mpm/simulation/state_set.hpp"
#include "page.hpp"

namespace body_contact_test {

using mpm::Vec3;
using namespace verification;

constexpr double kRoundOff = 1e-10;

/// Rigid bodies in a scene in space, and a small block in a corner that they do not meet.
std::string among_bodies(const std::string& bodies, const std::string& gravity = "[0, 0, -9.81]",
                         const std::string& walls = "{all: slip, z_min: fixed}",
                         const std::string& method = "{update: usavg}") {
  return fmt::format(R"(
name: meeting
geometry: solid
gravity: {}
grid: {{cell: 0.1, min: [-1, -1, 0], max: [1, 1, 2]}}
time: {{end: 2, sync: 0.002, step: 0.001}}
method: {}
materials: [{{name: clay, law: j2_plasticity, density: 1000, young: 0.1 MPa, poisson: 0.3, yield_stress: 10 kPa}}]
bodies: [{{name: block, material: clay, shape: {{box: {{min: [-1, -1, 0], max: [-0.8, -0.8, 0.2]}}}}}}]
boundaries: {}
rigid_bodies:
{})",
                     gravity, method, walls, bodies);
}

/// A slab whose upper face falls towards +x by `angle`, through the origin at z = 0.8.
std::string slope(double angle, double friction) {
  return fmt::format(
      "  - {{name: slope, shape: {{box: {{size: [1.4, 0.6, 0.2]}}}}, pose: {{position: [{}, 0, {}], rpy: [0, {}, 0]}}, "
      "collide: {{friction: {}}}}}\n",
      -0.1 * std::sin(angle), 0.8 - 0.1 * std::cos(angle), angle, friction);
}

Vec3 along(double angle) { return {std::cos(angle), 0.0, -std::sin(angle)}; }
Vec3 away(double angle) { return {std::sin(angle), 0.0, std::cos(angle)}; }

/// A box that lies on the slope.
std::string box_on_slope(double angle, double friction) {
  const Vec3 place = Vec3(0.0, 0.0, 0.8) + 0.05 * away(angle);
  return slope(angle, friction) +
         fmt::format(
             "  - {{name: box, shape: {{box: {{size: [0.2, 0.14, 0.1]}}}}, pose: {{position: [{}, 0, {}], rpy: [0, {}, "
             "0]}}, free: {{density: 400}}, collide: {{friction: 0.9}}}}\n",
             place.x(), place.z(), angle);
}

// The smaller friction counts. Sliding: g (sin - mu cos). A step updates the velocity before the position, so that the
// velocity after n steps is exact; gaps are zero to round-off.
TEST(BodyContact, ABoxSlidesDownASlopeByCoulombsLaw) {
  const double angle = 0.5, friction = 0.3, end = 0.3;
  mpm::Simulation run = run_of(among_bodies(box_on_slope(angle, friction)));
  run_until(run, end);
  const mpm::BodyState box = run.bodies()[1];
  const double expected = kFreeGravity * (std::sin(angle) - friction * std::cos(angle)) * end;
  EXPECT_NEAR(box.twist.linear.dot(along(angle)), expected, 1e-4 * expected);
  EXPECT_NEAR(box.twist.linear.dot(away(angle)), 0.0, 1e-4 * expected);
  EXPECT_LT(box.twist.angular.norm(), 1e-3);
  EXPECT_LT(imbalance(run.free_bodies()[0]), kRoundOff);
  // Friction took what falling gave and motion does not have; velocities are half a step ahead of places.
  const double mass = 400.0 * 0.2 * 0.14 * 0.1;
  const mpm::EnergyReport energy = run.state().energy;
  EXPECT_NEAR(energy.of("free_kinetic") + energy.of("free_potential") + energy.of("free_loss"),
              mass * kFreeGravity * (0.8 + 0.05 * std::cos(angle)),
              mass * kFreeGravity * std::sin(angle) * 0.001 * expected);
  EXPECT_GT(energy.of("free_loss"), 0.25);
}

TEST(BodyContact, ABoxStaysOnASlopeThatIsNotTooSteep) {
  mpm::Simulation run = run_of(among_bodies(box_on_slope(0.5, 0.6)));  // tan 0.5 = 0.546
  const Vec3 start = run.bodies()[1].pose.position;
  run_until(run, 1.0);
  EXPECT_LT((run.bodies()[1].pose.position - start).norm(), 1e-5);
  EXPECT_LT(run.bodies()[1].twist.linear.norm(), 1e-6);
}

// A solid sphere that does not slide has 5/7 of the acceleration of one that slides without friction.
TEST(BodyContact, ASphereRollsDownASlope) {
  const double angle = 0.3, end = 0.5;
  const Vec3 place = Vec3(-0.3 * std::cos(angle), 0.0, 0.8 + 0.3 * std::sin(angle)) + 0.1 * away(angle);
  mpm::Simulation run = run_of(among_bodies(
      slope(angle, 0.5) + fmt::format("  - {{name: ball, shape: {{sphere: {{radius: 0.1}}}}, pose: {{position: [{}, 0, "
                                      "{}]}}, free: {{density: 1000}}, collide: true}}\n",
                                      place.x(), place.z())));
  run_until(run, end);
  const mpm::BodyState ball = run.bodies()[1];
  const double expected = 5.0 / 7.0 * kFreeGravity * std::sin(angle) * end;
  EXPECT_NEAR(ball.twist.linear.dot(along(angle)), expected, 1e-4 * expected);
  EXPECT_NEAR(ball.twist.angular.y(), expected / 0.1, 1e-4 * expected / 0.1);
}

// Without rebound two spheres go on together along the line of their centres; linear and angular momentum stay.
TEST(BodyContact, TwoSpheresThatMeetKeepTheirMomentum) {
  for (const std::string method : {"{update: usavg}", "{update: implicit}"}) {
    mpm::Simulation run = run_of(among_bodies(
        R"(  - {name: one, shape: {sphere: {radius: 0.1}}, pose: {position: [-0.2, 0, 1]}, collide: {friction: 0},
     free: {mass: 2, velocity: [1, 0, 0]}}
  - {name: two, shape: {sphere: {radius: 0.1}}, pose: {position: [0.15, 0, 1]}, collide: {friction: 0},
     free: {mass: 1, velocity: [-0.5, 0, 0]}}
)",
        "[0, 0, 0]", "{all: slip, z_min: fixed}", method));
    run_until(run, 0.3);
    for (int body = 0; body < 2; ++body) {
      EXPECT_NEAR(run.bodies()[body].twist.linear.x(), 0.5, 1e-6) << method;  // (2 - 0.5) / 3
      EXPECT_LT(imbalance(run.free_bodies()[body]), kRoundOff) << method;
    }
    EXPECT_NEAR(run.bodies()[1].pose.position.x() - run.bodies()[0].pose.position.x(), 0.2, 2e-5) << method;
    // 0.5 * 2 + 0.5 * 0.25 before, 0.5 * 3 * 0.25 after
    EXPECT_NEAR(run.state().energy.of("free_loss"), 0.75, 1e-6) << method;
  }
}

// A box falls on a corner, comes to rest on the fixed floor on one of its faces, and stays. Nothing drives it.
TEST(BodyContact, ABoxFallsOnTheFloorAndComesToRest) {
  mpm::Simulation run = run_of(among_bodies(
      "  - {name: box, shape: {box: {size: [0.3, 0.2, 0.1]}}, pose: {position: [0.2, 0, 0.4], rpy: [0.4, 0.3, 0]}, "
      "free: {density: 500}, collide: true}\n"));
  const double start = run.free_bodies()[0].potential;
  double most = 0.0;
  while (seconds(run) < 2.0 - 1e-9) {
    run.advance();
    const mpm::FreeBodyReport now = run.free_bodies()[0];
    most = std::max(most, now.kinetic + now.potential - start);
  }
  // Velocities are half a step ahead of positions: g dt v.
  EXPECT_LT(most, 500.0 * 6e-3 * kFreeGravity * 0.001 * 2.5);
  const mpm::BodyState box = run.bodies()[0];
  EXPECT_NEAR(box.pose.position.z(), 0.05, 1e-4);
  EXPECT_LT(box.twist.linear.norm(), 1e-4);
  EXPECT_LT(box.twist.angular.norm(), 1e-3);
}

// Three boxes on each other: the floor carries all, and none sinks.
TEST(BodyContact, AStackStands) {
  std::string bodies;
  for (int k = 0; k < 3; ++k) {
    bodies += fmt::format(
        "  - {{name: box_{}, shape: {{box: {{size: [0.2, 0.2, 0.1]}}}}, pose: {{position: [0.2, 0, {}]}}, free: "
        "{{density: 500}}, collide: true}}\n",
        k, 0.05 + 0.1 * k);
  }
  mpm::Simulation run = run_of(among_bodies(bodies));
  run_until(run, 1.0);
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT((run.bodies()[k].pose.position - Vec3(0.2, 0.0, 0.05 + 0.1 * k)).norm(), 2e-4) << k;
  }
}

/// A block on clay, and a load on it.
const char* const kLoadOnBlock =
    R"(  - {name: plate, shape: {box: {size: [0.16, 0.16, 0.1]}}, pose: {position: [-0.9, -0.9, 0.25]},
     free: {mass: 0.4}, collide: true, friction: 0.3}
  - {name: load, shape: {box: {size: [0.1, 0.1, 0.1]}}, pose: {position: [-0.9, -0.9, 0.351]}, free: {mass: 2}, collide: true}
)";

// A block that nothing but clay holds up is pressed by a box that lies on it: the clay carries both weights. The block
// is a fifth of the box's mass, so that a contact that lags a step behind would shake it.
TEST(BodyContact, ClayCarriesABoxThroughABlock) {
  for (const std::string method : {"{update: usavg}", "{update: implicit}"}) {
    mpm::Simulation run = run_of(among_bodies(kLoadOnBlock, "[0, 0, -9.81]", "{all: slip}", method));
    run_until(run, 1.0);
    run.take_contact(0);
    run_until(run, 2.0);
    EXPECT_NEAR(run.take_contact(0).mean.force.z(), 2.4 * kFreeGravity, 0.01 * 2.4 * kFreeGravity) << method;
    EXPECT_LT(run.bodies()[1].twist.linear.norm(), 1e-2) << method;
    // The load lies on the block, which may lean.
    const mpm::Pose block = run.bodies()[0].pose;
    EXPECT_NEAR(block.to_body(run.bodies()[1].pose.position).z(), 0.1, 1e-4) << method;
  }
}

// A plate pushes a box over the rough floor. What it does is what motion, friction and the impact take.
TEST(BodyContact, APlatePushesABoxAndItsWorkIsCounted) {
  mpm::Simulation run = run_of(among_bodies(
      R"(  - {name: plate, shape: {box: {size: [0.1, 0.4, 0.4]}}, pose: {position: [0, 0, 0.25]}, collide: {friction: 0},
     motion: {velocity: [0.5, 0, 0]}}
  - {name: box, shape: {box: {size: [0.2, 0.2, 0.2]}}, pose: {position: [0.2, 0, 0.1]}, collide: {friction: 0.4}, free: {mass: 2}}
)"));
  const double start = run.free_bodies()[0].potential;
  run_until(run, 1.0);
  const mpm::EnergyReport energy = run.state().energy;
  const double weight = 2.0 * kFreeGravity, way = run.bodies()[1].pose.position.x() - 0.2;
  EXPECT_NEAR(way, 0.45, 1e-3);  // the plate is 0.05 m away at the start
  // Friction over the way, and as much as the box moves with for the impact, which takes as much again.
  const double expected = 0.4 * weight * way + 2.0 * 0.5 * 0.5;
  EXPECT_NEAR(energy.of("collision_work"), expected, 2e-3 * expected);
  EXPECT_NEAR(energy.of("free_kinetic") + energy.of("free_potential") - start + energy.of("free_loss"),
              energy.of("collision_work"), 1e-3 * expected);
}

// A solid disc has 2/3 of the acceleration of one that does not roll.
TEST(BodyContact, ADiscRollsDownASlopeOfAPlane) {
  const double angle = 0.3, end = 0.4;
  const Vec3 place = Vec3(-0.3 * std::cos(angle), 0.0, 0.3 * std::sin(angle)) + 0.1 * away(angle);
  mpm::Simulation run =
      run_of(fmt::format(R"(
name: plane
geometry: plane_strain
gravity: [0, -9.81]
grid: {{cell: 0.1, min: [-1, -1], max: [1, 1]}}
time: {{end: 2, sync: 0.002, step: 0.001}}
method: {{update: usavg}}
materials: [{{name: clay, law: j2_plasticity, density: 1000, young: 0.1 MPa, poisson: 0.3, yield_stress: 10 kPa}}]
bodies: [{{name: block, material: clay, shape: {{box: {{min: [-1, -1], max: [-0.8, -0.8]}}}}}}]
boundaries: {{all: slip}}
rigid_bodies:
  - {{name: slope, shape: {{box: {{size: [1.4, 0.2]}}}}, pose: {{position: [{}, {}], rpy: [0, {}, 0]}}, collide: true}}
  - {{name: disc, shape: {{sphere: {{radius: 0.1}}}}, pose: {{position: [{}, {}]}}, free: {{density: 1000}}, collide: true}}
)",
                         -0.1 * std::sin(angle), -0.1 * std::cos(angle), angle, place.x(), place.z()));
  run_until(run, end);
  const double expected = 2.0 / 3.0 * kFreeGravity * std::sin(angle) * end;
  EXPECT_NEAR(run.bodies()[1].twist.linear.dot(along(angle)), expected, 1e-4 * expected);
  EXPECT_NEAR(run.bodies()[1].twist.angular.y(), expected / 0.1, 1e-4 * expected / 0.1);
}

TEST(BodyContact, SameBitsForAnyNumberOfThreads) {
  for (const std::string& bodies : {box_on_slope(0.5, 0.3), std::string(kLoadOnBlock)}) {
    const std::string text = among_bodies(bodies);
    mpm::Simulation one = run_of(text), two = run_of(text, {}, 2);
    run_until(one, 0.1);
    run_until(two, 0.1);
    EXPECT_EQ(one.state_hash(), two.state_hash());
  }
}

TEST(BodyContact, StatesThatOverlapAreRefused) {
  mpm::Simulation run = run_of(among_bodies(kLoadOnBlock));
  run_until(run, 0.05);
  const mpm::Pose before = run.bodies()[1].pose;
  mpm::StateSet set;
  set.name = "load";
  set.pose = mpm::Pose{{-0.9, -0.9, 0.33}, mpm::Quat::Identity()};
  EXPECT_THROW(run.set_state(set), mpm::RigidError);
  EXPECT_EQ(run.bodies()[1].pose.position, before.position);
  set.pose->position.z() = 0.4;
  run.set_state(set);
  EXPECT_EQ(run.bodies()[1].pose.position.z(), 0.4);
}

TEST(BodyContact, OverlapsAtTheStartAreRefused) {
  const std::string two =
      R"(  - {name: one, shape: {sphere: {radius: 0.1}}, pose: {position: [0, 0, 1]}, collide: true, free: {mass: 1}}
  - {name: two, shape: {box: {size: [0.2, 0.2, 0.2]}}, pose: {position: [0.15, 0, 1]}, collide: OTHER}
)";
  const auto with = [&](const std::string& other) {
    std::string text = two;
    text.replace(text.find("OTHER"), 5, other);
    return among_bodies(text);
  };
  EXPECT_NO_THROW(run_of(with("{except: [one]}")));
  EXPECT_NO_THROW(run_of(with("false")));
  try {
    run_of(with("true"));
    FAIL() << "expected an error";
  } catch (const mpm::Error& error) {
    EXPECT_NE(std::string(error.what()).find("'two' and 'one' overlap by 0.05 m"), std::string::npos) << error.what();
  }
  EXPECT_THROW(run_of(with("{except: [three]}")), mpm::Error);
  EXPECT_THROW(run_of(among_bodies("  - {name: low, shape: {sphere: {radius: 0.2}}, pose: {position: [0, 0, 0.1]}, "
                                   "collide: true, free: {mass: 1}}\n")),
               mpm::Error);
}

}  // namespace body_contact_test
