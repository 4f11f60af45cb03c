// Links that meet bodies, walls and each other, against balances that need no simulation. Cost: 3 s.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"
#include "robot_case.hpp"

namespace robot_collide_test {

using namespace mpm;
using namespace robot_test;

/// Robots and bodies over a fixed floor at z = 0, and a small block that they do not meet.
Simulation run_on_floor(const std::string& more, int threads = 1) {
  provide_robots();
  const std::string text = fmt::format(R"(
name: floor
gravity: [0, 0, -9.81]
grid: {{cell: 0.1, min: [-2, -2, 0], max: [2, 2, 2]}}
time: {{end: 2, sync: 0.002, step: 0.001}}
method: {{update: usavg}}
materials: [{{name: clay, law: j2_plasticity, density: 1000, young: 0.1 MPa, poisson: 0.3, yield_stress: 10 kPa}}]
bodies: [{{name: block, material: clay, shape: {{box: {{min: [-2, -2, 0], max: [-1.8, -1.8, 0.2]}}}}}}]
boundaries: {{all: slip, z_min: fixed}}
{})",
                                       more);
  return Simulation(build(parse_scene(text, "floor.yaml")), {threads});
}

/// A train of cart, middle and wagon on slides, 0.3 m above the floor.
std::string train(const std::string& joints) {
  return fmt::format(R"(robots:
  - name: train
    urdf: {}
    base: {{pose: {{position: [0, 0, 0.3]}}}}
    links: {{cart: {{friction: 0}}, wagon: {{friction: 0}}}}
    collide: {{friction: 0}}
    joints: {}
)",
                     data_file("train.urdf"), joints);
}

void go(Simulation& run, double end) {
  while (seconds_of(run.time()) < end - 1e-9) run.advance();
}

// 20 N push cart, middle and wagon, which hold together, and before them a box of 2 kg that rubs on the floor:
// (F - mu m g) / (M + m). The wagon is smooth, so that the floor alone carries the box.
TEST(RobotCollide, ALinkPushesABox) {
  Simulation run =
      run_on_floor(train("{first: {drive: effort, target: 20}, second: {drive: position}, third: {drive: position}}") +
                   R"(rigid_bodies:
  - {name: box, shape: {box: {size: [0.2, 0.6, 0.6]}}, pose: {position: [0.6, 0, 0.3]}, free: {mass: 2}, collide: {friction: 0.4}}
)");
  go(run, 0.3);
  const double expected = (20.0 - 0.4 * 2.0 * 9.81) / (3.5 + 2.0) * 0.3;
  const BodyState box = run.bodies()[run.find_body("box")];
  EXPECT_NEAR(box.twist.linear.x(), expected, 1e-3 * expected);
  EXPECT_NEAR(run.robots()[0].joints[0].velocity, expected, 1e-3 * expected);
  // Holding the wagon takes its part of the force: that of the box and of its own mass.
  EXPECT_NEAR(run.robots()[0].joints[2].effort, 0.4 * 2.0 * 9.81 + 4.0 * expected / 0.3, 0.05);
}

// A force within the train pulls the wagon to the cart, which it meets after 0.4 s with 1 m/s and takes along. Such
// forces change no momentum, before, while and after the two meet.
TEST(RobotCollide, LinksOfOneRobotMeetEachOther) {
  Simulation run = run_on_floor(train("{third: {drive: effort, target: -5}}"));
  double most = 0.0;
  for (int k = 0; k < 250; ++k) {
    run.advance();
    const RobotReport robot = run.robots()[0];
    const double cart = robot.joints[0].velocity, middle = cart + robot.joints[1].velocity,
                 wagon = middle + robot.joints[2].velocity;
    most = std::max(most, std::abs(cart + 0.5 * middle + 2.0 * wagon));
  }
  EXPECT_LT(most, 1e-9);
  const double cart = run.robots()[0].joints[0].velocity;
  EXPECT_NEAR(cart, -2.0 / 3.0 - 5.0 / 3.0 * 0.1, 0.01);
  const Vec3 apart = run.bodies()[1].pose.position - run.bodies()[0].pose.position;
  EXPECT_NEAR(apart.x(), 0.2, 1e-4);
  EXPECT_NEAR(run.bodies()[1].twist.linear.x(), cart, 1e-6);
}

// A free leg falls 2 cm on the floor of the domain and stands on its round foot, of 4 cm: nothing gives it energy, but
// for the half step's fall that velocities are ahead.
TEST(RobotCollide, ALegStandsOnTheFloor) {
  Simulation run = run_on_floor(fmt::format(R"(robots:
  - name: leg
    urdf: {}
    base: {{kind: free, pose: {{position: [0, 0, 0.26]}}}}
    links: {{foot: {{collide: true}}}}
    joints:
      hip_joint: {{drive: position, stiffness: 20, damping: 0.1}}
      knee: {{drive: position, stiffness: 20, damping: 0.1}}
)",
                                            data_file("leg.urdf")));
  const double start = run.robots()[0].energies.potential;
  double most = 0.0;
  for (int k = 0; k < 500; ++k) {
    run.advance();
    const RobotEnergies now = run.robots()[0].energies;
    most = std::max(most, now.kinetic + now.potential - start);
  }
  EXPECT_LT(most, 0.035 * 9.81 * 0.001 * 0.7);  // m g dt v
  EXPECT_NEAR(run.robots()[0].base.position.z(), 0.24, 1e-4);
  EXPECT_LT(run.robots()[0].base_twist.linear.norm(), 1e-3);
}

TEST(RobotCollide, SameBitsForAnyNumberOfThreads) {
  const std::string text = train("{third: {drive: effort, target: -5}}");
  Simulation one = run_on_floor(text), two = run_on_floor(text, 2);
  go(one, 0.5);
  go(two, 0.5);
  EXPECT_EQ(one.state_hash(), two.state_hash());
}

}  // namespace robot_collide_test
