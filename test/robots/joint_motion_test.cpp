// Joints without material: a double pendulum against its own equations, static efforts of an arm, limits, friction,
// saturated drives, and a free base. Cost: 8 s.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "robot_case.hpp"

namespace joint_motion_test {

using namespace mpm;
using namespace robot_test;

constexpr double kG = 9.81;

/// Angles from the vertical and rates of a double pendulum with masses 2 kg and 1 kg on rods of 1 m.
using State = std::array<double, 4>;

/// Lagrange's equations with absolute angles a and b (Landau & Lifshitz, Mechanics, section 5, problem 1).
State rates(const State& s) {
  const double m1 = 2.0, m2 = 1.0;
  const double a = s[0], b = s[1], va = s[2], vb = s[3], d = a - b;
  const double m11 = m1 + m2, m12 = m2 * std::cos(d), m22 = m2;
  const double f1 = -m2 * std::sin(d) * vb * vb - (m1 + m2) * kG * std::sin(a);
  const double f2 = m2 * std::sin(d) * va * va - m2 * kG * std::sin(b);
  const double det = m11 * m22 - m12 * m12;
  return {va, vb, (m22 * f1 - m12 * f2) / det, (m11 * f2 - m12 * f1) / det};
}

State after(State s, double time, int steps) {
  const double h = time / steps;
  const auto add = [](const State& x, double f, const State& y) {
    State r;
    for (int i = 0; i < 4; ++i) r[i] = x[i] + f * y[i];
    return r;
  };
  for (int k = 0; k < steps; ++k) {
    const State k1 = rates(s), k2 = rates(add(s, 0.5 * h, k1)), k3 = rates(add(s, 0.5 * h, k2)),
                k4 = rates(add(s, h, k3));
    for (int i = 0; i < 4; ++i) s[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
  }
  return s;
}

// 10 s of a swing from 40 and 70 degrees; the step is that of a fine scene. Positions are of second order: the first
// velocity of leapfrog is half a step before the start, where it is 0 to the step's first power.
TEST(JointMotion, DoublePendulumFollowsItsEquationsAndKeepsItsEnergy) {
  RobotDefinition definition = load("double_pendulum.urdf");
  definition.joints[0].position = 40.0 * kDegree;
  definition.joints[1].position = 30.0 * kDegree;
  std::vector<RigidBody> none;
  Robot robot(definition, kGravity, none);
  const RobotEnergies begin = robot.report().energies;
  const double swing = 3.0 * kG * (1.0 - std::cos(40.0 * kDegree)) + kG * (1.0 - std::cos(70.0 * kDegree));
  const double dt = 2e-5;
  double largest = 0.0;
  for (int k = 0; k < 100; ++k) {
    run(robot, 5000, dt, 0.1 * k);
    const RobotEnergies now = robot.report().energies;
    largest = std::max(largest, std::abs(now.kinetic + now.potential - begin.kinetic - begin.potential));
  }
  EXPECT_LT(largest, 1e-4 * swing);
  const State exact = after({40.0 * kDegree, 70.0 * kDegree, 0.0, 0.0}, 10.0, 200000);
  const RobotReport end = robot.report();
  // The error grows along with that of the start, half a step's fall: 1e-3 rad are some fifty of these.
  EXPECT_NEAR(end.joints[0].position, exact[0], 1e-3);
  EXPECT_NEAR(end.joints[0].position + end.joints[1].position, exact[1], 1e-3);
}

// Moments of weights about each joint, by hand. The load is at 1 m, so that the arms are those of the URDF.
TEST(JointMotion, StaticEffortsOfAnArmThatCarriesALoad) {
  std::vector<RigidBody> none;
  Robot robot(load("arm.urdf", JointDrive::position), kGravity, none);
  run(robot, 3, 1e-3);
  const RobotReport report = robot.report();
  const double shoulder = kG * (4.0 * 0.25 + 2.5 * 0.7 + 0.8 * 0.95 + 3.0 * 1.0);
  const double elbow = kG * (2.5 * 0.2 + 0.8 * 0.45 + 3.0 * 0.5), wrist = kG * (0.8 * 0.05 + 3.0 * 0.1);
  // About y a weight ahead turns the arm down, which is positive; the drive holds against it.
  EXPECT_NEAR(report.joints[0].effort, -shoulder, 1e-6 * shoulder);
  EXPECT_NEAR(report.joints[1].effort, -elbow, 1e-6 * elbow);
  EXPECT_NEAR(report.joints[2].effort, -wrist, 1e-6 * wrist);
  EXPECT_EQ(report.joints[0].position, 0.0);
}

// A spring of stiffness k holds the arm where k times the distance is the moment of the weights, which is
// proportional to the cosine of the angle.
TEST(JointMotion, StiffnessAndItsDeflection) {
  RobotDefinition definition = load("arm.urdf", JointDrive::position);
  definition.joints[0].stiffness = 4e3;
  definition.joints[0].damping = 300.0;
  std::vector<RigidBody> none;
  Robot robot(definition, kGravity, none);
  run(robot, 20000, 1e-3);
  const JointReport shoulder = robot.report().joints[0];
  // Centres of the links above the shoulder's axis turn with it: 4 kg are 0.02 m above.
  const double ahead = kG * (4.0 * 0.25 + 2.5 * 0.7 + 0.8 * 0.95 + 3.0 * 1.0), above = kG * 4.0 * 0.02;
  const double angle = shoulder.position;
  const double moment = ahead * std::cos(angle) + above * std::sin(angle);
  EXPECT_NEAR(4e3 * angle, moment, 1e-9 * moment);
  EXPECT_NEAR(shoulder.effort, -moment, 1e-9 * moment);
}

TEST(JointMotion, ADriveGivesWayAtTheLimitOfItsEffort) {
  RobotDefinition definition = load("arm.urdf", JointDrive::position);
  definition.joints[2].effort = 1.0;  // the wrist needs 3.3 N m
  std::vector<RigidBody> none;
  Robot robot(definition, kGravity, none);
  run(robot, 100, 1e-3);
  const RobotReport report = robot.report();
  EXPECT_DOUBLE_EQ(report.joints[2].effort, -1.0);
  EXPECT_GT(report.joints[2].position, 0.01);
  EXPECT_EQ(report.joints[1].position, 0.0);
}

TEST(JointMotion, ALimitStopsAJointAndTakesItsEnergy) {
  RobotDefinition definition = load("arm.urdf", JointDrive::position);
  definition.joints[2].drive = JointDrive::effort;
  definition.model.joints[2].upper = 0.5;
  std::vector<RigidBody> none;
  Robot robot(definition, kGravity, none);
  const RobotEnergies begin = robot.report().energies;
  run(robot, 2000, 1e-3);
  const RobotReport report = robot.report();
  EXPECT_EQ(report.joints[2].position, 0.5);
  EXPECT_EQ(report.joints[2].velocity, 0.0);
  EXPECT_EQ(report.joints[2].effort, 0.0);
  const RobotEnergies& end = report.energies;
  const double lost = begin.potential + begin.kinetic - end.potential - end.kinetic;
  EXPECT_GT(lost, 1.0);
  // A limit takes the motion within one step: an error of its mean velocity is one of the step's first power.
  EXPECT_NEAR(-(end.limit + end.drive + end.damping), lost, 0.02 * lost);
}

// Friction above the moment of the weight holds the joint; below it slides.
TEST(JointMotion, FrictionHoldsUpToItsLimit) {
  RobotDefinition definition = load("arm.urdf", JointDrive::position);
  definition.joints[2].drive = JointDrive::effort;
  const double moment = kG * (0.8 * 0.05 + 3.0 * 0.1);
  std::vector<RigidBody> none;
  definition.model.joints[2].friction = 1.01 * moment;
  Robot held(definition, kGravity, none);
  run(held, 200, 1e-3);
  EXPECT_EQ(held.report().joints[2].position, 0.0);
  definition.model.joints[2].friction = 0.5 * moment;
  Robot slides(definition, kGravity, none);
  run(slides, 100, 1e-3);
  // Half of the moment is left: a fall of 0.1 s at half the acceleration, while the angle is small.
  const double inertia = 0.002 + 0.8 * 0.05 * 0.05 + 0.01 + 3.0 * 0.1 * 0.1;
  EXPECT_NEAR(slides.report().joints[2].position, 0.25 * moment / inertia * 0.01, 0.03);
}

// A robot thrown with a spin about an oblique axis, joints loose: its momentum is that of gravity's impulse, its energy
// stays.
TEST(JointMotion, AFreeBaseFallsWithItsLinks) {
  RobotDefinition definition = load("arm.urdf");
  definition.base.kind = BaseKind::free;
  definition.model.links[0].mass = 1.0;
  definition.model.links[0].inertia = 0.1 * Mat3::Identity();
  definition.model.joints[0].damping = 0.0;
  definition.joints[1].position = 0.7;
  std::vector<RigidBody> none;
  Robot robot(definition, kGravity, none);
  const RobotEnergies begin = robot.report().energies;
  const double time = 0.5, dt = 1e-5;
  run(robot, 50000, dt);
  const RobotReport report = robot.report();
  // Nothing but weight acts, so nothing turns or bends, and the base falls as a stone does.
  EXPECT_NEAR(report.base.position.z(), -0.5 * kG * time * (time + dt), 1e-9);
  EXPECT_NEAR(report.joints[0].position, 0.0, 1e-9);
  EXPECT_NEAR(report.joints[1].position, 0.7, 1e-9);
  EXPECT_NEAR(report.base.orientation.vec().norm(), 0.0, 1e-9);
  const double change = report.energies.kinetic + report.energies.potential - begin.kinetic - begin.potential;
  EXPECT_LT(std::abs(change), 1e-4 * report.energies.kinetic);
}

// Joints driven against each other in free flight turn the base; the momentum of all links, by their masses and the
// velocities of their centres of mass, stays what it was.
TEST(JointMotion, DrivesOfAFreeRobotGiveItNoMomentum) {
  RobotDefinition definition = load("double_pendulum.urdf");
  definition.base.kind = BaseKind::free;
  definition.model.links[0].mass = 1.0;
  definition.model.links[0].inertia = 0.1 * Mat3::Identity();
  definition.joints[0].target = 0.4;
  definition.joints[1].target = -0.3;
  std::vector<RigidBody> none;
  Robot robot(definition, Vec3::Zero(), none);
  const auto centre = [&](const RobotReport& at) {
    const Vec3 base = at.base.position;
    const auto rod = [&](double angle) {
      return Vec3(at.base.orientation * Vec3(std::sin(angle), 0.0, -std::cos(angle)));
    };
    const double a = at.joints[0].position, b = a + at.joints[1].position;
    const Vec3 first = base + rod(a), second = first + rod(b);
    return Vec3((base + 2.0 * first + second) / 4.0);
  };
  const Vec3 start = centre(robot.report());
  run(robot, 20000, 1e-4);
  const RobotReport end = robot.report();
  EXPECT_GT(std::abs(end.joints[0].position), 0.1);
  // An error of first order in the step: 2 s of motion at some 0.5 m/s.
  EXPECT_LT((centre(end) - start).norm(), 1e-4);
}

// The elbow follows the shoulder by -2: one freedom, with the moments of both by virtual work.
TEST(JointMotion, AMimicJointGivesItsMomentsToTheOneThatItFollows) {
  RobotDefinition definition = load("arm.urdf", JointDrive::position);
  definition.model.joints[1].mimic = Mimic{0, -2.0, 0.0};
  definition.joints.erase(definition.joints.begin() + 1);
  std::vector<RigidBody> none;
  Robot robot(definition, kGravity, none);
  run(robot, 3, 1e-3);
  const double shoulder = kG * (4.0 * 0.25 + 2.5 * 0.7 + 0.8 * 0.95 + 3.0 * 1.0);
  const double elbow = kG * (2.5 * 0.2 + 0.8 * 0.45 + 3.0 * 0.5);
  EXPECT_NEAR(robot.report().joints[0].effort, -(shoulder - 2.0 * elbow), 1e-6 * shoulder);
  robot.follow(0, {{0.0, 0.0, 0.0}, {0.1, 0.2, 0.0}}, 0.003);
  run(robot, 200, 1e-3, 0.003);
  EXPECT_NEAR(robot.report().joints[0].position, 0.2, 1e-12);
  EXPECT_NEAR(robot.report().joints[1].position, -0.4, 1e-12);
}

TEST(JointMotion, ATrajectoryPassesItsPointsWithTheirVelocities) {
  std::vector<RigidBody> none;
  Robot robot(load("arm.urdf", JointDrive::position), kGravity, none);
  robot.follow(1, {{0.1, 0.2, 1.0}, {0.3, 0.3, 0.0}}, 0.0);
  run(robot, 100, 1e-3);
  EXPECT_NEAR(robot.report().joints[1].position, 0.2, 1e-12);
  EXPECT_NEAR(robot.report().joints[1].velocity, 1.0, 0.05);  // the mean of the last step, with 100 rad/s^2
  run(robot, 300, 1e-3, 0.1);
  EXPECT_NEAR(robot.report().joints[1].position, 0.3, 1e-12);
  EXPECT_NEAR(robot.report().joints[1].velocity, 0.0, 1e-9);
}

}  // namespace joint_motion_test
