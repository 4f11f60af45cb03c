// Wrench commands: read, queued beside velocities, applied, recorded and read again.
#include <gtest/gtest.h>
#include <tf2/buffer_core.h>

#include <cmath>

#include "mpm/scene/scene.hpp"
#include "mpm_ros/command/command_reader.hpp"
#include "mpm_ros/message/bag_error.hpp"

namespace wrench_command_test {

using namespace mpm_ros;

constexpr std::int64_t kSync = 10'000'000;

mpm::Simulation scene() {
  return mpm::Simulation(mpm::build(mpm::parse_scene(R"(
name: wrench
geometry: solid
grid: {cell: 0.25, min: [-1, -1, -1], max: [1, 1, 1]}
time: {end: 1, sync: 0.01}
materials: [{name: rubber, law: neo_hookean, density: 1000, young: 0.1 MPa, poisson: 0.3}]
bodies: [{name: block, material: rubber, shape: {box: {min: [-1, -1, -1], max: [-0.75, -0.75, -0.75]}}}]
rigid_bodies:
  - {name: probe, shape: {sphere: {radius: 0.1}}}
  - {name: wheel, shape: {sphere: {radius: 0.1}}, pose: {position: [0.5, 0, 0]}, free: {mass: 2, axes: [x, y, z]}}
  - {name: ball, shape: {sphere: {radius: 0.1}}, pose: {position: [0, 0.5, 0]}, free: {mass: 2}}
)",
                                                     "wrench.yaml")),
                         {1});
}

class WrenchCommands : public testing::Test {
 protected:
  mpm::Simulation simulation_ = scene();
  tf2::BufferCore frames_;
  CommandQueue queue_{kSync};
  NodeHealth health_;
  CommandReader reader_{{"probe", "wheel", "ball"}, "world", "bodies/", frames_, queue_, health_};
};

TEST_F(WrenchCommands, ActBesideVelocities) {
  geometry_msgs::Wrench wrench;
  wrench.force.x = 4.0;
  geometry_msgs::Twist twist;
  twist.angular.y = 3.0;
  reader_.take(1, twist);
  reader_.take(1, wrench);
  const std::vector<DueCommand> due = queue_.take(0);
  ASSERT_EQ(due.size(), 2u);  // neither ended the other
  for (const DueCommand& one : due) apply(in_world(one, simulation_.bodies(), 0), simulation_);
  simulation_.advance();
  const mpm::BodyState wheel = simulation_.bodies()[1];
  EXPECT_EQ(wheel.twist.angular.y(), 3.0);
  EXPECT_NEAR(wheel.twist.linear.x(), 4.0 / 2.0 * 0.01, 1e-15);
}

TEST_F(WrenchCommands, ComeAtTheirStampInTheirFrame) {
  Stamps stamps;
  reader_.set_stamps(stamps);
  geometry_msgs::WrenchStamped wrench;
  wrench.header.stamp = stamps.at(2 * kSync);
  wrench.header.frame_id = "probe";
  wrench.wrench.force.x = 1.0;
  wrench.wrench.torque.x = 2.0;
  reader_.take(2, wrench);
  EXPECT_TRUE(queue_.take(0).empty());
  EXPECT_TRUE(queue_.take(kSync).empty());
  const std::vector<DueCommand> due = queue_.take(2 * kSync);
  ASSERT_EQ(due.size(), 1u);
  std::vector<mpm::BodyState> bodies = simulation_.bodies();
  bodies[0].pose.orientation = mpm::Quat(Eigen::AngleAxisd(M_PI / 2.0, mpm::Vec3::UnitZ()));
  const AppliedCommand applied = in_world(due[0], bodies, 2 * kSync);
  EXPECT_LT((applied.wrench.force - mpm::Vec3(0.0, 1.0, 0.0)).norm(), 1e-15);
  EXPECT_LT((applied.wrench.torque - mpm::Vec3(0.0, 2.0, 0.0)).norm(), 1e-15);
}

TEST_F(WrenchCommands, AreRecordedAndReadAgain) {
  AppliedCommand command;
  command.body = 2;
  command.kind = CommandKind::wrench;
  command.wrench = {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  command.effect = kSync;
  const mpm_ros::Command message = to_message(command, "ball", "world", Stamps());
  EXPECT_EQ(message.kind, mpm_ros::Command::WRENCH);
  const AppliedCommand again = from_message(message, simulation_);
  EXPECT_EQ(again.kind, CommandKind::wrench);
  EXPECT_EQ(again.wrench.force, command.wrench.force);
  EXPECT_EQ(again.wrench.torque, command.wrench.torque);
  EXPECT_EQ(again.effect, kSync);
}

TEST_F(WrenchCommands, AreRefusedForWhatHasNoMassOrIsNotFinite) {
  AppliedCommand command;
  command.kind = CommandKind::wrench;
  EXPECT_THROW(apply(command, simulation_), mpm::RigidError);
  geometry_msgs::Wrench wrench;
  wrench.torque.z = NAN;
  reader_.take(2, wrench);
  EXPECT_EQ(queue_.waiting(), 0u);
}

TEST_F(WrenchCommands, StopWhatWasCommanded) {
  EXPECT_EQ(stop_commands(0, simulation_).size(), 1u);  // velocity alone
  EXPECT_EQ(stop_commands(1, simulation_).size(), 2u);
  const std::vector<AppliedCommand> ball = stop_commands(2, simulation_);
  ASSERT_EQ(ball.size(), 1u);  // it has no velocity command
  EXPECT_EQ(ball[0].kind, CommandKind::wrench);
  simulation_.apply_wrench(2, {{1.0, 0.0, 0.0}, mpm::Vec3::Zero()});
  apply(ball[0], simulation_);
  simulation_.advance();
  EXPECT_EQ(simulation_.bodies()[2].twist.linear.x(), 0.0);
}

}  // namespace wrench_command_test
