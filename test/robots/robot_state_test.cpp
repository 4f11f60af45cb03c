// States of robots that are set between two steps. Cost: 3 s.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm/simulation/state_set.hpp"
#include "robot_case.hpp"

namespace robot_state_test {

using namespace mpm;
using namespace robot_test;

void no_check(const std::vector<const RigidBody*>& /*moved*/) {}

// Masses of 2 and 1 kg on rods of 1 m; angles add up. The energy of the masses by hand, before and after.
TEST(RobotState, JointsArePutAndTheirEnergyIsBooked) {
  RobotDefinition definition = load("double_pendulum.urdf");
  definition.joints[0].position = 0.3;
  std::vector<RigidBody> none;
  Robot robot(definition, kGravity, none);
  const auto energy = [](double a, double b, double va, double vb) {
    const double x = std::cos(a) * va, z = std::sin(a) * va, c = a + b, vc = va + vb;
    const double square = std::pow(x + std::cos(c) * vc, 2) + std::pow(z + std::sin(c) * vc, 2);
    return 0.5 * (2.0 * va * va + square) - 9.81 * (3.0 * std::cos(a) + std::cos(c));
  };
  robot.set_state({}, {}, {{"elbow", "shoulder"}, {-0.7, 0.5}, {1.5, -2.0}}, no_check);
  RobotReport report = robot.report();
  EXPECT_EQ(report.joints[0].position, 0.5);
  EXPECT_EQ(report.joints[1].position, -0.7);
  EXPECT_EQ(report.joints[0].velocity, -2.0);
  EXPECT_EQ(report.joints[1].velocity, 1.5);
  const double given = energy(0.5, -0.7, -2.0, 1.5) - energy(0.3, 0.0, 0.0, 0.0);
  EXPECT_NEAR(report.energies.set, given, 1e-7 * std::abs(given));  // moments of inertia of 1e-9 kg m^2 count
  run(robot, 20000, 2e-5);
  report = robot.report();
  const double now = report.energies.kinetic + report.energies.potential;
  EXPECT_NEAR(now, energy(0.5, -0.7, -2.0, 1.5), 2e-4 * std::abs(given));  // half a step's fall, as without it
  // Without velocities joints are at rest, and one that is not named goes on.
  const double kept = report.joints[0].velocity;
  robot.set_state({}, {}, {{"elbow"}, {0.1}, {}}, no_check);
  EXPECT_EQ(robot.report().joints[1].velocity, 0.0);
  EXPECT_EQ(robot.report().joints[0].velocity, kept);
}

std::string scene(const std::string& base, const std::string& down = "velocity") {
  return fmt::format(R"(
name: clay
gravity: [0, 0, -9.81]
grid: {{cell: 0.04, min: [-0.32, -0.2, -0.16], max: [0.32, 0.2, 0.4]}}
time: {{end: 0.1, cfl: 0.5, sync: 0.0002}}
materials: [{{name: clay, law: j2_plasticity, density: 1800, young: 2 MPa, poisson: 0.4, yield_stress: 10 kPa}}]
bodies: [{{name: bed, material: clay, shape: {{box: {{min: [-0.32, -0.2, -0.16], max: [0.32, 0.2, 0]}}}}}}]
boundaries: {{all: slip, z_max: none}}
robots:
  - name: gantry
    urdf: {}
    base: {}
    links: {{plate: {{friction: 0.3}}}}
    joints: {{along: {{drive: position}}, down: {{drive: {}}}, turn: {{drive: position}}}}
)",
                     data_file("gantry.urdf"), base, down);
}

Simulation run_of(const std::string& text) {
  provide_robots();
  return Simulation(build(parse_scene(text, "robot.yaml")), {1});
}

StateSet joints(const std::vector<std::string>& names, const std::vector<double>& positions) {
  StateSet set;
  set.name = "gantry";
  set.joints = names;
  set.positions = positions;
  return set;
}

// The slide `down` points down, so that its position is how much lower the plate is.
TEST(RobotState, LinksAndDrivesGoWhereJointsArePut) {
  Simulation run = run_of(scene("{pose: {position: [0, 0, 0.1]}}"));
  for (int k = 0; k < 5; ++k) run.advance();
  run.set_state(joints({"along", "down"}, {0.05, -0.1}));
  EXPECT_LT((run.bodies()[0].pose.position - Vec3(0.05, 0.0, 0.2)).norm(), 1e-15);
  for (int k = 0; k < 5; ++k) run.advance();
  // A rigid drive by position holds there; that by velocity stands still, as it is told.
  EXPECT_EQ(run.robots()[0].joints[0].position, 0.05);
  EXPECT_EQ(run.robots()[0].joints[1].position, -0.1);
  StateSet base;
  base.name = "gantry";
  base.pose = Pose{Vec3(-0.1, 0.0, 0.1), Quat::Identity()};
  run.set_state(base);
  EXPECT_LT((run.bodies()[0].pose.position - Vec3(-0.05, 0.0, 0.2)).norm(), 1e-15);
  run.advance();
  EXPECT_LT((run.bodies()[0].pose.position - Vec3(-0.05, 0.0, 0.2)).norm(), 1e-15);
}

TEST(RobotState, WhatCannotBeIsRefusedAndChangesNothing) {
  Simulation run = run_of(scene("{kind: moving, pose: {position: [0, 0, 0.1]}}"));
  for (int k = 0; k < 5; ++k) run.advance();
  const std::uint64_t before = run.memory_hash();
  const auto expect = [&](const StateSet& set, const char* words) {
    try {
      run.set_state(set);
      ADD_FAILURE() << words;
    } catch (const RigidError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
    EXPECT_EQ(run.memory_hash(), before) << words;
  };
  expect(joints({"alng"}, {0.1}), "along");
  expect(joints({"along"}, {1.5}), "limits from -1 to 1");
  expect(joints({"along"}, {}), "1 joints, 0 positions");
  expect(joints({"down"}, {0.12}), "more than half a cell");  // the plate is 6 cm thick
  expect(joints({}, {}), "neither a pose of its base nor a joint");
  StateSet twisted;
  twisted.name = "gantry";
  twisted.pose = Pose{};
  twisted.twist.linear.x() = 0.1;
  expect(twisted, "its velocity is commanded");
  StateSet link = twisted;
  link.name = "gantry/plate";
  expect(link, "a link of robot 'gantry'");
  run.advance();
}

}  // namespace robot_state_test
