// Commands in an axisymmetric scene: a tool stays on the axis and upright under any command, and a refused command
// changes nothing.
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/scene/scene.hpp"
#include "mpm_ros/command/body_command.hpp"
#include "mpm_ros/message/markers.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace axial_command_test {

class AxialCommand : public testing::Test {
 protected:
  mpm::Simulation simulation_{mpm::build(mpm::load_scene(data_file("indenter.yaml"))), {1}};
  int cone_ = simulation_.find_body("cone"), jaws_ = simulation_.find_body("jaws");

  static AppliedCommand velocity(int body, const mpm::Vec3& linear, const mpm::Vec3& angular = mpm::Vec3::Zero()) {
    AppliedCommand command;
    command.body = body;
    command.twist = {linear, angular};
    return command;
  }
  AppliedCommand pose(int body, const mpm::Vec3& position, const mpm::Quat& orientation = mpm::Quat::Identity()) const {
    AppliedCommand command;
    command.kind = CommandKind::pose;
    command.body = body;
    command.pose = {position, orientation};
    command.arrival = 10 * simulation_.sync_period();
    return command;
  }
  void expect_refused(const AppliedCommand& command, const std::string& text) {
    const mpm::RigidBody& body = simulation_.rigid_body(command.body);
    const mpm::Drive drive = body.drive();
    const mpm::Twist twist = body.twist();
    try {
      apply(command, simulation_);
      ADD_FAILURE() << "it was taken: " << text;
    } catch (const mpm::RigidError& error) {
      EXPECT_NE(std::string(error.what()).find("'" + body.name() + "'"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
    EXPECT_EQ(body.drive(), drive);
    EXPECT_EQ(body.twist().linear, twist.linear);
    EXPECT_EQ(body.twist().angular, twist.angular);
  }
};

TEST_F(AxialCommand, AlongTheAxisIsTaken) {
  apply(velocity(cone_, {0.0, 0.0, -0.1}), simulation_);
  EXPECT_EQ(simulation_.rigid_body(cone_).twist().linear, mpm::Vec3(0.0, 0.0, -0.1));
  apply(pose(cone_, {0.0, 0.0, 0.06}), simulation_);
  EXPECT_EQ(simulation_.rigid_body(cone_).drive(), mpm::Drive::pose);
  apply(velocity(cone_, mpm::Vec3::Zero()), simulation_);
  EXPECT_EQ(simulation_.rigid_body(cone_).twist().linear, mpm::Vec3::Zero());
}

TEST_F(AxialCommand, OffTheAxisTiltedOrTurnedIsRefused) {
  expect_refused(velocity(cone_, {0.01, 0.0, -0.1}),
                 "velocity along x is 0.01 m/s, but in an axisymmetric scene a tool");
  expect_refused(velocity(cone_, {0.0, -0.01, -0.1}), "velocity along y is -0.01 m/s");
  expect_refused(velocity(cone_, {0.0, 0.0, -0.1}, {0.0, 0.5, 0.0}), "rotation rate about y is 0.5 rad/s");
  expect_refused(velocity(cone_, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.5}), "rotation rate about z is 0.5 rad/s");
  expect_refused(pose(cone_, {0.01, 0.0, 0.045}), "position along x is 0.01 m");
  expect_refused(pose(cone_, {0.0, 0.0, 0.045}, mpm::Quat(Eigen::AngleAxisd(0.2, mpm::Vec3::UnitX()))),
                 "its pose is turned by 0.2 rad");
  expect_refused(pose(cone_, {0.0, 0.0, 0.045}, mpm::Quat(Eigen::AngleAxisd(0.2, mpm::Vec3::UnitZ()))),
                 "its pose is turned by 0.2 rad");
  // It continues to follow the command before.
  apply(velocity(cone_, {0.0, 0.0, -0.1}), simulation_);
  expect_refused(velocity(cone_, {1.0, 0.0, 0.0}), "velocity along x is 1 m/s");
}

TEST_F(AxialCommand, NoiseIsDropped) {
  // The commanded speed is 0.1 m/s; the cone's farthest corner is hypot(0.03, 0.03, 0.05) = 0.066 m from its origin.
  apply(velocity(cone_, {0.9e-7, -0.9e-7, -0.1}, {1e-6, 0.0, -1e-6}), simulation_);
  EXPECT_EQ(simulation_.rigid_body(cone_).twist().linear, mpm::Vec3(0.0, 0.0, -0.1));
  EXPECT_EQ(simulation_.rigid_body(cone_).twist().angular, mpm::Vec3::Zero());
  expect_refused(velocity(cone_, {1.1e-7, 0.0, -0.1}), "velocity along x");
  apply(pose(cone_, {1e-8, 0.0, 0.06}, mpm::Quat(Eigen::AngleAxisd(1e-6, mpm::Vec3::UnitX()))), simulation_);
  for (int i = 0; i < 10; ++i) simulation_.advance();
  EXPECT_EQ(simulation_.rigid_body(cone_).pose().position, mpm::Vec3(0.0, 0.0, 0.06));
  EXPECT_EQ(simulation_.rigid_body(cone_).pose().orientation.coeffs(), mpm::Quat::Identity().coeffs());
}

TEST_F(AxialCommand, WhatIsNotFiniteIsTheBodysOwnError) {
  expect_refused(velocity(cone_, {std::nan(""), 0.0, 0.0}), "not finite");
  expect_refused(pose(cone_, {std::nan(""), 0.0, 0.0}), "not finite");
}

TEST_F(AxialCommand, ARingOpensAlongXAlone) {
  apply(velocity(jaws_, {-0.02, 0.0, 0.01}), simulation_);
  EXPECT_EQ(simulation_.rigid_body(jaws_).twist().linear, mpm::Vec3(-0.02, 0.0, 0.01));
  expect_refused(velocity(jaws_, {-0.02, 0.1, 0.0}), "a ring moves along z and opens along x alone");
  expect_refused(pose(jaws_, {-0.06, 0.0, 0.1}), "the ring has closed");
}

TEST_F(AxialCommand, ARingThatClosesEndsTheRun) {
  // Its inner radius is 0.055 m, which it closes at 3 m/s in 18 ms without meeting anything.
  apply(velocity(jaws_, {-3.0, 0.0, 0.0}), simulation_);
  try {
    while (simulation_.time() < 20'000'000) simulation_.advance();
    FAIL() << "it went on";
  } catch (const mpm::PhysicsError& error) {
    EXPECT_NE(std::string(error.what()).find("the ring has closed"), std::string::npos) << error.what();
  }
  EXPECT_GE(simulation_.time() + simulation_.sync_period(), 18'000'000);
}

TEST_F(AxialCommand, AToolIsDrawnWhole) {
  const visualization_msgs::MarkerArray array = shape_markers(simulation_);
  double farthest = 0.0;
  for (const geometry_msgs::Point& point : array.markers.at(cone_).points)
    farthest = std::max(farthest, std::abs(point.y));
  EXPECT_NEAR(farthest, 0.03, 1e-15);
}

}  // namespace axial_command_test
}  // namespace mpm_ros
