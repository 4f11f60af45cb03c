// Commands that a simulation refuses: motions that cannot be meant for a tool.
#include "mpm_ros/command/body_command.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mpm/scene/scene.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace body_command_test {

class TooFast : public testing::Test {
 protected:
  mpm::Scene scene_ = mpm::load_scene(data_file("press.yaml"));
  mpm::Simulation simulation_{mpm::build(scene_), {1}};
  // The domain is 0.2 x 0.12 m.
  double diagonal_ = std::hypot(0.2, 0.12);
  double sync_ = static_cast<double>(simulation_.sync_period()) * 1e-9;
  AppliedCommand command_;

  void SetUp() override { command_.body = simulation_.find_body("plate"); }
  void expect_refused() {
    try {
      apply(command_, simulation_);
      FAIL() << "it was taken";
    } catch (const mpm::RigidError& error) {
      EXPECT_NE(std::string(error.what()).find("'plate'"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("diagonal"), std::string::npos) << error.what();
    }
    EXPECT_EQ(simulation_.rigid_body(command_.body).drive(), mpm::Drive::functions);
  }
  void expect_taken() {
    apply(command_, simulation_);
    EXPECT_NE(simulation_.rigid_body(command_.body).drive(), mpm::Drive::functions);
  }
};

TEST_F(TooFast, VelocityOfMoreThanTheDiagonalInASyncPeriod) {
  command_.twist.linear.x() = 1.001 * diagonal_ / sync_;
  expect_refused();
  command_.twist.linear.x() = 0.999 * diagonal_ / sync_;
  expect_taken();
}

TEST_F(TooFast, RotationCountsAtTheFarthestCorner) {
  // The plate is 0.14 x 0.04 m about its origin, and endless along y.
  const double reach = std::hypot(0.07, 0.02);
  command_.twist.angular.y() = 1.001 * diagonal_ / sync_ / reach;
  expect_refused();
  command_.twist.angular.y() = 0.999 * diagonal_ / sync_ / reach;
  expect_taken();
}

TEST_F(TooFast, PoseThatIsFarForItsTime) {
  command_.kind = CommandKind::pose;
  command_.pose = simulation_.rigid_body(command_.body).pose();
  command_.pose.position.z() += 5.0 * diagonal_;
  command_.arrival = 4 * simulation_.sync_period();
  expect_refused();
  command_.arrival = 6 * simulation_.sync_period();
  expect_taken();
}

TEST_F(TooFast, WhatAPlaneDoesNotHaveIsNoTravel) {
  // The pose of a robot's link beside the plane of the scene, slightly tilted about x.
  command_.kind = CommandKind::pose;
  command_.pose = simulation_.rigid_body(command_.body).pose();
  command_.pose.position.y() = 20.0 * diagonal_;
  command_.pose.orientation = Eigen::AngleAxisd(0.1, mpm::Vec3::UnitX());
  command_.arrival = simulation_.sync_period();
  EXPECT_EQ(jump_of(command_, simulation_), "");
  expect_taken();
}

TEST_F(TooFast, APoseOfMoreThanACellInASyncPeriodIsAJump) {
  command_.kind = CommandKind::pose;
  command_.pose = simulation_.rigid_body(command_.body).pose();
  command_.arrival = 2 * simulation_.sync_period();
  command_.pose.position.z() += 1.99 * 0.01;  // over two periods; a cell is 10 mm
  EXPECT_EQ(jump_of(command_, simulation_), "");
  command_.pose.position.z() += 0.02 * 0.01;
  const std::string jump = jump_of(command_, simulation_);
  EXPECT_EQ(jump.substr(0, 27), "'plate' jumps 2.01 cells, f") << jump;  // distance, start and goal
  EXPECT_NE(jump.find("rom (0.1, 0, 0.065) to (0.1, 0, 0.0851) m"), std::string::npos) << jump;
  expect_taken();  // accepted and carried out
  command_.kind = CommandKind::velocity;
  command_.twist.linear.z() = 100.0;  // an explicit velocity has no such limit
  EXPECT_EQ(jump_of(command_, simulation_), "");
}

TEST_F(TooFast, OverflowIsRefused) {
  command_.twist.linear.x() = 1e308;
  command_.twist.angular.y() = -1e308;
  expect_refused();
}

}  // namespace body_command_test
}  // namespace mpm_ros
