// A rigid body follows the last command, and refuses commands that it cannot follow.
#include "mpm/rigid/rigid_body.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace mpm {
namespace rigid_body_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

RigidBodyDefinition blade() {
  RigidBodyDefinition definition;
  definition.name = "blade";
  definition.surface = make_sphere(0.1);
  definition.pose.position = {1.0, 0.0, 0.5};
  return definition;
}

/// Makes `steps` equal steps over the 10 ms after `from` [ns], and the sync point at their end.
void run_sync(RigidBody& body, std::int64_t from, int steps) {
  const double dt = 0.01 / steps;
  for (int i = 0; i < steps; ++i) {
    body.begin_step(1e-9 * static_cast<double>(from) + i * dt, dt);
    body.end_step(dt);
  }
  body.at_sync(from + 10'000'000);
}

/// Message of the RigidError that `action` throws; empty when it throws none.
template <typename Action>
std::string refusal(Action&& action) {
  try {
    action();
  } catch (const RigidError& error) {
    return error.what();
  }
  return "";
}

TEST(RigidBody, FollowsItsFunctions) {
  RigidBodyDefinition definition = blade();
  definition.velocity = {0.2, 0.0, -0.1};
  definition.rotation_rate = {0.0, 3.0, 0.0};
  RigidBody body(definition);
  EXPECT_EQ(body.drive(), Drive::functions);
  for (int i = 0; i < 10; ++i) run_sync(body, i * 10'000'000LL, 7);
  EXPECT_LT((body.pose().position - Vec3(1.02, 0.0, 0.49)).norm(), 1e-14);  // 0.1 s; round-off of 70 steps
  const Quat turned(Eigen::AngleAxisd(0.3, Vec3::UnitY()));
  EXPECT_LT((body.pose().orientation.coeffs() - turned.coeffs()).norm(), 1e-14);
  EXPECT_EQ(body.twist().linear, Vec3(0.2, 0.0, -0.1));
}

TEST(RigidBody, FunctionsAreReadInTheMiddleOfTheStep) {
  // For v = 2 t the midpoint rule is exact: x = t^2.
  RigidBodyDefinition definition = blade();
  definition.velocity[0] = Function::parse("2*t");
  RigidBody body(definition);
  body.begin_step(0.0, 0.5);
  EXPECT_EQ(body.twist().linear.x(), 0.5);
  body.end_step(0.5);
  body.begin_step(0.5, 0.5);
  body.end_step(0.5);
  EXPECT_NEAR(body.pose().position.x(), 1.0 + 1.0, 1e-15);
}

TEST(RigidBody, VelocityCommandReplacesTheFunctions) {
  RigidBodyDefinition definition = blade();
  definition.velocity = {5.0, 5.0, 5.0};
  RigidBody body(definition);
  body.command_velocity({{0.0, 1.0, 0.0}, Vec3::Zero()});
  EXPECT_EQ(body.drive(), Drive::velocity);
  for (int i = 0; i < 3; ++i) run_sync(body, i * 10'000'000LL, 4);
  EXPECT_LT((body.pose().position - Vec3(1.0, 0.03, 0.5)).norm(), 1e-15);
}

TEST(RigidBody, ReachesTheTargetPoseAndRests) {
  RigidBody body(blade());
  const Pose target{{1.3, -0.7, 0.11}, Quat(0.3, -0.5, 0.7, 0.2).normalized()};
  body.command_pose(target, 0, 30'000'000);
  EXPECT_EQ(body.drive(), Drive::pose);
  EXPECT_LT((body.twist().linear - Vec3(0.3, -0.7, -0.39) / 0.03).norm(), 1e-13);  // for numbers of size 30
  run_sync(body, 0, 13);
  run_sync(body, 10'000'000, 13);
  EXPECT_GT((body.pose().position - target.position).norm(), 0.1);  // one third to go
  run_sync(body, 20'000'000, 13);
  EXPECT_EQ(body.pose().position, target.position);  // exactly, not to rounding
  EXPECT_EQ(body.pose().orientation.coeffs(), target.orientation.coeffs());
  EXPECT_GT(body.twist().linear.norm(), 20.0);  // that of the last step, not yet at rest
  run_sync(body, 30'000'000, 5);
  EXPECT_EQ(body.twist().linear, Vec3::Zero());
  EXPECT_EQ(body.twist().angular, Vec3::Zero());
  EXPECT_EQ(body.pose().position, target.position);
}

TEST(RigidBody, ArrivesBetweenSyncPointsWithoutOvershoot) {
  RigidBody body(blade());
  Pose target = body.pose();
  target.position.x() += 0.1;
  body.command_pose(target, 0, 4'500'000);  // in the middle of the fifth of ten steps
  double farthest = 0.0;
  for (int i = 0; i < 10; ++i) {
    body.begin_step(i * 1e-3, 1e-3);
    body.end_step(1e-3);
    farthest = std::max(farthest, body.pose().position.x());
    if (i == 4) {
      EXPECT_NEAR(body.pose().position.x(), 1.1, 1e-15);
    }
  }
  EXPECT_LE(farthest, 1.1 + 1e-15);
  EXPECT_NEAR(body.twist().linear.norm(), 0.0, 1e-12);  // 1e-15 m of rounding over 1 ms
}

TEST(RigidBody, NewCommandReplacesTheOld) {
  RigidBody body(blade());
  Pose far = body.pose();
  far.position.x() += 10.0;
  body.command_pose(far, 0, 20'000'000);
  run_sync(body, 0, 4);  // half of the distance: x = 6
  Pose near = body.pose();
  near.position.z() += 0.2;
  body.command_pose(near, 10'000'000, 20'000'000);
  EXPECT_LT((body.twist().linear - Vec3(0.0, 0.0, 20.0)).norm(), 1e-12);
  run_sync(body, 10'000'000, 4);
  EXPECT_EQ(body.pose().position, near.position);
  body.command_velocity({{0.0, 0.0, -1.0}, Vec3::Zero()});
  run_sync(body, 20'000'000, 4);  // the pose has been reached and has no further effect
  EXPECT_NEAR(body.pose().position.z(), near.position.z() - 0.01, 1e-15);
}

TEST(RigidBody, NotFiniteCommandsAreRefusedAndChangeNothing) {
  RigidBody body(blade());
  body.command_velocity({{0.0, 0.0, 1.0}, Vec3::Zero()});
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    EXPECT_NE(refusal([&] { body.command_velocity({{0.0, bad, 0.0}, Vec3::Zero()}); }), "");
    EXPECT_NE(refusal([&] { body.command_velocity({Vec3::Zero(), {0.0, 0.0, bad}}); }), "");
    EXPECT_NE(refusal([&] { body.command_pose({{bad, 0.0, 0.0}, Quat::Identity()}, 0, 10); }), "");
    EXPECT_NE(refusal([&] { body.command_pose({Vec3::Zero(), Quat(1.0, bad, 0.0, 0.0)}, 0, 10); }), "");
  }
  EXPECT_NE(refusal([&] { body.command_pose({}, 10, 10); }), "");
  EXPECT_NE(refusal([&] { body.command_pose({}, 10, 0); }), "");
  EXPECT_EQ(body.drive(), Drive::velocity);
  EXPECT_EQ(body.twist().linear, Vec3(0.0, 0.0, 1.0));
}

TEST(RigidBody, QuaternionLength) {
  RigidBody body(blade());
  const Quat turn = Quat(Eigen::AngleAxisd(0.4, Vec3::UnitX()));
  const auto scaled = [&](double length) { return Pose{{1.0, 0.0, 0.5}, Quat(length * turn.coeffs())}; };
  EXPECT_EQ(refusal([&] { body.command_pose(scaled(0.0), 0, 10'000'000); }),
            "rigid body 'blade': pose command: orientation is a quaternion of length 0; send one of length 1");
  EXPECT_NE(refusal([&] { body.command_pose(scaled(1.002), 0, 10'000'000); }), "");
  EXPECT_NE(refusal([&] { body.command_pose(scaled(0.998), 0, 10'000'000); }), "");
  body.command_pose(scaled(1.0009), 0, 10'000'000);
  run_sync(body, 0, 3);
  EXPECT_NEAR(body.pose().orientation.norm(), 1.0, 1e-15);
  EXPECT_LT((body.pose().orientation.coeffs() - turn.coeffs()).norm(), 1e-15);
}

TEST(RigidBody, ImpossibleDefinitionsAreRefused) {
  const auto made_with = [](auto change) {
    return refusal([&] {
      RigidBodyDefinition definition = blade();
      change(definition);
      RigidBody body(definition);
    });
  };
  EXPECT_EQ(made_with([](auto&) {}), "");
  EXPECT_EQ(made_with([](auto& d) { d.surface = nullptr; }), "rigid body 'blade': it has no shape");
  EXPECT_EQ(made_with([](auto& d) { d.friction.coefficient = -0.5; }),
            "rigid body 'blade': friction coefficient is -0.5; it must be finite and not negative");
  EXPECT_NE(made_with([](auto& d) { d.friction.coefficient = kNan; }), "");
  EXPECT_NE(made_with([](auto& d) { d.pose.orientation = Quat(0.0, 0.0, 0.0, 0.0); }), "");
  EXPECT_NE(made_with([](auto& d) { d.pose.position.x() = kNan; }), "");
  EXPECT_NE(made_with([](auto& d) { d.name.clear(); }), "");
}

}  // namespace rigid_body_test
}  // namespace mpm
