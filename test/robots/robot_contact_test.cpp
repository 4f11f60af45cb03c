// Links on material: a robot whose joints are all prescribed against the same rigid body, efforts of joints against the
// wrench of the material, sensors, a robot much lighter than what it stands on. Cost: 30 s.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"
#include "robot_case.hpp"

namespace robot_contact_test {

using namespace mpm;
using namespace robot_test;

/// Clay under tools; `more`: rigid bodies or robots. Its step is the sync period.
std::string clay(const std::string& more, const std::string& update = "usavg") {
  return fmt::format(R"(
name: clay
gravity: [0, 0, -9.81]
grid: {{cell: 0.04, min: [-0.32, -0.2, -0.16], max: [0.32, 0.2, 0.4]}}
time: {{end: 0.1, cfl: 0.5, sync: 0.0002}}
method: {{update: {}}}
materials: [{{name: clay, law: j2_plasticity, density: 1800, young: 2 MPa, poisson: 0.4, yield_stress: 10 kPa}}]
bodies: [{{name: bed, material: clay, shape: {{box: {{min: [-0.32, -0.2, -0.16], max: [0.32, 0.2, 0]}}}}}}]
boundaries: {{all: slip, z_max: none}}
{})",
                     update, more);
}

Simulation run_of(const std::string& text, int threads = 1) {
  provide_robots();
  return Simulation(build(parse_scene(text, "robot.yaml")), {threads});
}

std::string gantry() {
  return fmt::format(R"(robots:
  - name: gantry
    urdf: {}
    base: {{pose: {{position: [0, 0, 0.035]}}}}
    links: {{plate: {{friction: 0.3}}}}
    joints:
      along: {{drive: velocity, target: 0.2}}
      down: {{drive: velocity, target: "0.4 * (t < 0.05) + 0"}}
      turn: {{drive: velocity, target: 1}}
)",
                     data_file("gantry.urdf"));
}

// The plate's origin moves on a straight line and it turns about it, so that its motion is a rigid body's to
// round-off.
TEST(RobotContact, PrescribedJointsActAsTheSameRigidBody) {
  Simulation robot = run_of(clay(gantry()), 2);
  Simulation body = run_of(clay(R"(rigid_bodies:
  - name: plate
    shape: {box: {size: [0.16, 0.16, 0.06]}}
    pose: {position: [0, 0, 0.035]}
    friction: 0.3
    motion: {velocity: [0.2, 0, "-0.4 * (t < 0.05) + 0"], rotation_rate: [0, 1, 0]
      }
)"));
  double most = 0.0, apart = 0.0;
  for (int k = 0; k < 200; ++k) {
    robot.advance();
    body.advance();
    const ContactReport a = robot.take_contact(0), b = body.take_contact(0);
    most = std::max(most, b.mean.force.norm());
    apart = std::max(apart, (a.mean.force - b.mean.force).norm());
  }
  EXPECT_GT(most, 100.0);
  EXPECT_LT(apart, 1e-9 * most);
  EXPECT_LT((robot.bodies()[0].pose.position - body.bodies()[0].pose.position).norm(), 1e-12);
}

// Each sync period has one step, so its mean wrench is that of the step, about the plate's origin at its start.
TEST(RobotContact, EffortsAreThoseOfTheMaterialsWrench) {
  for (const std::string update : {"usavg", "implicit"}) {
    Simulation run = run_of(clay(fmt::format(R"(robots:
  - name: arm
    urdf: {}
    base: {{pose: {{position: [-0.3, 0, 0.035]}}}}
    links: {{plate: {{friction: 0.3}}}}
    joints: {{shoulder: {{drive: velocity, target: 0.8}}, elbow: {{drive: velocity, target: -0.4}}}}
)",
                                             data_file("press_arm.urdf")),
                                 update));
    double most = 0.0, apart = 0.0;
    for (int k = 0; k < 400; ++k) {
      const Vec3 origin = run.bodies()[0].pose.position, shoulder(-0.3, 0.0, 0.035);
      const std::uint64_t steps = run.state().step.steps;
      run.advance();
      ASSERT_EQ(run.state().step.steps, steps + 1);
      const Wrench wrench = run.take_contact(0).mean;
      const RobotReport robot = run.robots()[0];
      const double about_elbow = wrench.torque.y();  // the plate's origin is at the elbow
      const double about_shoulder = about_elbow + (origin - shoulder).cross(wrench.force).y();
      most = std::max(most, std::abs(about_shoulder));
      apart = std::max(
          {apart, std::abs(robot.joints[0].effort + about_shoulder), std::abs(robot.joints[1].effort + about_elbow)});
    }
    EXPECT_GT(most, 10.0) << update;
    EXPECT_LT(apart, 1e-9 * most) << update;
  }
}

/// A free leg with stiff joints that falls on the clay from 2 cm.
std::string leg(const std::string& update, double height = 0.26) {
  return clay(fmt::format(R"(robots:
  - name: leg
    urdf: {}
    base: {{kind: free, pose: {{position: [0, 0, {}]}}}}
    links: {{foot: {{friction: 0.5}}}}
    joints:
      hip_joint: {{drive: position, stiffness: 20, damping: 0.1}}
      knee: {{drive: position, stiffness: 20, damping: 0.1}}
)",
                          data_file("leg.urdf"), height),
              update);
}

// A hundredth of the clay's density: stable where a penalty or a body that lags a step behind is not. Nothing drives
// it, so its energy never exceeds that of the start, but for the half step's fall that the velocities are ahead.
TEST(RobotContact, ALightLegStandsOnClayWithoutGainingEnergy) {
  for (const std::string update : {"usavg", "implicit"}) {
    const bool clear = update == "implicit";
    Simulation run = run_of(leg(update, clear ? 0.28 : 0.26));
    const double start = run.robots()[0].energies.potential;
    double most = 0.0, speed = 0.0;
    for (int k = 0; k < 1500; ++k) {
      run.advance();
      const RobotReport robot = run.robots()[0];
      most = std::max(most, robot.energies.kinetic + robot.energies.potential - start);
      speed = robot.base_twist.linear.norm();
    }
    EXPECT_LT(most, 1e-3 * 0.0173 * 9.81 * 0.02) << update;  // energy of the fall: its mass, g and height
    EXPECT_LT(speed, 0.05) << update;
    // Implicit steps let a body act about half a cell, 2 cm, further out (implicit/tool_rows.hpp).
    const double height = clear ? 0.26 : 0.24;
    EXPECT_LT((run.robots()[0].base.position - Vec3(0.0, 0.0, height)).norm(), 0.01) << update;
  }
}

// The slide pushes down with 60 N at the most, which with the weight of column and plate (4 kg) the clay carries.
TEST(RobotContact, ADriveStallsWhereTheClayCarriesItsLimit) {
  for (const std::string update : {"usavg", "implicit"}) {
    Simulation run = run_of(clay(fmt::format(R"(robots:
  - name: gantry
    urdf: {}
    base: {{pose: {{position: [0, 0, 0.04]}}}}
    links: {{plate: {{friction: 0.3}}}}
    joints:
      along: {{drive: velocity}}
      down: {{drive: velocity, target: 0.1, effort: 60}}
      turn: {{drive: position}}
)",
                                             data_file("gantry.urdf")),
                                 update));
    Vec3 before = Vec3::Zero();
    double drive_before = 0.0, place_before = 0.0;
    for (int k = 0; k < 1500; ++k) {
      if (k == 1000) {
        before = run.take_contact(0).impulse;
        drive_before = run.robots()[0].joints[1].impulse;
        place_before = run.robots()[0].joints[1].position;
      }
      run.advance();
    }
    const RobotReport end = run.robots()[0];
    const double force = (run.take_contact(0).impulse - before).z() / 0.1;
    EXPECT_NEAR((end.joints[1].impulse - drive_before) / 0.1, 60.0, 1e-6) << update;
    // Mean of 0.1 s: the clay still rings, more in explicit steps. The target would be 1 cm farther.
    EXPECT_LT(std::abs(end.joints[1].position - place_before), 1e-3) << update;
    EXPECT_NEAR(force, 60.0 + 4.0 * 9.81, 2.0) << update;
  }
}

TEST(RobotContact, ACheckpointGoesOnToTheBit) {
  const std::string text = leg("usavg"), file = testing::TempDir() + "robot_contact.h5";
  Simulation whole = run_of(text), part = run_of(text), again = run_of(text);
  for (int k = 0; k < 500; ++k) whole.advance();
  for (int k = 0; k < 350; ++k) part.advance();
  save_checkpoint(file, part, {"robot.yaml", text, {}});
  load_checkpoint(file, again, text);
  for (int k = 350; k < 500; ++k) again.advance();
  EXPECT_EQ(again.state_hash(), whole.state_hash());
  EXPECT_EQ(again.robots()[0].energies.contact, whole.robots()[0].energies.contact);
}

// Nothing that is driven or falls moves while a bed settles under its weight.
TEST(RobotContact, ARobotWaitsWhileABedSettles) {
  std::string text = leg("usavg");
  const std::string bed = "material: clay,";
  text.replace(text.find(bed), bed.size(), bed + " initial: geostatic,");
  Simulation run = run_of(text);
  const RobotReport robot = run.robots()[0];
  EXPECT_EQ(robot.base.position.z(), 0.26);
  EXPECT_EQ(robot.joints[0].position, 0.0);
  EXPECT_EQ(run.take_contact(0).impulse, Vec3(Vec3::Zero()));
}

// A plate on a base that moves as the rigid body does, with a wrist at rest.
TEST(RobotContact, AMovingBaseActsAsTheSameRigidBody) {
  Simulation robot = run_of(clay(fmt::format(R"(robots:
  - name: gantry
    urdf: {}
    base:
      pose: {{position: [0, 0, 0.035]}}
      motion: {{velocity: [0.2, 0, -0.2], rotation_rate: [0, 0, 0.5]}}
    links: {{plate: {{friction: 0.3}}}}
    joints: {{along: {{drive: position}}, down: {{drive: position}}, turn: {{drive: position}}}}
)",
                                             data_file("gantry.urdf"))));
  Simulation body = run_of(clay(R"(rigid_bodies:
  - name: plate
    shape: {box: {size: [0.16, 0.16, 0.06]}}
    pose: {position: [0, 0, 0.035]}
    friction: 0.3
    motion: {velocity: [0.2, 0, -0.2], rotation_rate: [0, 0, 0.5]}
)"));
  double most = 0.0, apart = 0.0;
  for (int k = 0; k < 400; ++k) {
    robot.advance();
    body.advance();
    const ContactReport a = robot.take_contact(0), b = body.take_contact(0);
    most = std::max(most, b.mean.force.norm());
    apart = std::max(apart, (a.mean.force - b.mean.force).norm());
  }
  EXPECT_GT(most, 100.0);
  EXPECT_LT(apart, 1e-9 * most);
}

// The same by commands: a velocity, then a pose that is reached at its time.
TEST(RobotContact, ACommandedBaseActsAsTheCommandedBody) {
  Simulation robot = run_of(clay(fmt::format(R"(robots:
  - name: gantry
    urdf: {}
    base: {{kind: moving, pose: {{position: [0, 0, 0.035]}}}}
    links: {{plate: {{friction: 0.3}}}}
    joints: {{along: {{drive: position}}, down: {{drive: position}}, turn: {{drive: position}}}}
)",
                                             data_file("gantry.urdf"))));
  Simulation body = run_of(clay(R"(rigid_bodies:
  - name: plate
    shape: {box: {size: [0.16, 0.16, 0.06]}}
    pose: {position: [0, 0, 0.035]}
    friction: 0.3
)"));
  EXPECT_EQ(robot.find_commanded("gantry/plate"), 0);
  const int base = robot.find_commanded("gantry");
  ASSERT_EQ(base, 1);
  const Pose target{Vec3(0.02, 0.0, 0.02), Quat(Eigen::AngleAxisd(0.1, Vec3::UnitZ()))};
  double most = 0.0, apart = 0.0;
  for (int k = 0; k < 400; ++k) {
    for (Simulation* run : {&robot, &body}) {
      const int index = run == &robot ? base : 0;
      if (k == 0) run->command_velocity(index, {Vec3(0.2, 0.0, -0.2), Vec3(0.0, 0.0, 0.5)});
      if (k == 200) run->command_pose(index, target, 70'000'000);
      run->advance();
    }
    const ContactReport a = robot.take_contact(0), b = body.take_contact(0);
    most = std::max(most, b.mean.force.norm());
    apart = std::max(apart, (a.mean.force - b.mean.force).norm());
  }
  EXPECT_GT(most, 100.0);
  EXPECT_LT(apart, 1e-9 * most);
  EXPECT_EQ(robot.robots()[0].base.position, target.position);
  EXPECT_EQ(robot.robots()[0].base_twist.linear, Vec3(Vec3::Zero()));
}

// The plate weighs 1 kg. At rest a sensor reads its weight or nothing; on the clay both read the same besides.
TEST(RobotContact, ASensorWithoutGravityLeavesOutTheWeightAlone) {
  const auto run_with = [](const char* gravity) {
    return run_of(clay(fmt::format(R"(robots:
  - name: gantry
    urdf: {}
    base: {{pose: {{position: [0, 0, 0.035]}}}}
    links: {{plate: {{friction: 0.3}}}}
    joints: {{along: {{drive: position}}, down: {{drive: velocity, target: "0.4 * (t > 0.01) + 0"}}, turn: {{drive: position}}}}
    sensors: {{turn: {{gravity: {}}}}}
)",
                                   data_file("gantry.urdf"), gravity)));
  };
  Simulation with = run_with("true"), without = run_with("false");
  double most = 0.0, apart = 0.0;
  for (int k = 0; k < 300; ++k) {
    with.advance();
    without.advance();
    const Wrench a = with.robots()[0].sensors[0].wrench, b = without.robots()[0].sensors[0].wrench;
    if (k == 20) {
      EXPECT_NEAR(a.force.z(), 9.81, 1e-9);
      EXPECT_LT(b.force.norm(), 1e-9);
    }
    most = std::max(most, b.force.norm());
    apart = std::max(apart, (a.force - b.force - Vec3(0.0, 0.0, 9.81)).norm());
  }
  EXPECT_GT(most, 100.0);
  EXPECT_LT(apart, 1e-9 * most);
}

// At 100 m/s, above the clay, a cell of 4 cm is crossed in 0.4 ms: so many steps in the first sync period as in the
// next.
TEST(RobotContact, TheFirstStepsKnowHowFastDrivesAre) {
  std::string text = clay(fmt::format(R"(robots:
  - name: gantry
    urdf: {}
    base: {{pose: {{position: [0, 0, 0.3]}}}}
    links: {{plate: {{friction: 0.3}}}}
    joints: {{along: {{drive: velocity, target: 100}}, down: {{drive: position}}, turn: {{drive: position}}}}
)",
                                      data_file("gantry.urdf")));
  const std::string sync = "sync: 0.0002";
  text.replace(text.find(sync), sync.size(), "sync: 0.001");
  Simulation run = run_of(text);
  run.advance();
  const std::uint64_t first = run.state().step.steps;
  run.advance();
  EXPECT_EQ(run.state().step.steps, 2 * first);
  EXPECT_GE(first, 3u);  // 0.1 m of way
}

TEST(RobotContact, TheSameBitsForAnyNumberOfThreads) {
  Simulation one = run_of(leg("usavg")), two = run_of(leg("usavg"), 2);
  for (int k = 0; k < 400; ++k) {
    one.advance();
    two.advance();
  }
  EXPECT_EQ(one.state_hash(), two.state_hash());
}

}  // namespace robot_contact_test
