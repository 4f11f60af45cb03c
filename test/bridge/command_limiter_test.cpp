// Bodies with limits: ramps and braking against numbers computed by hand. Sync points are 2 ms apart; the sled of
// test/data/drive.yaml is limited to 0.4 m/s and 20 m/s^2, which is 0.04 m/s a sync period.
#include "mpm_ros/command/command_limiter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mpm/scene/scene.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace command_limiter_test {

constexpr double kPeriod = 0.002;
constexpr double kRound = 1e-12;  // round-off of lengths of 0.1 m, summed over some hundred periods

class Limiter : public testing::Test {
 protected:
  mpm::Scene scene_ = mpm::load_scene(data_file("drive.yaml"));
  mpm::Simulation simulation_{mpm::build(scene_), {1}};
  NodeHealth health_;
  CommandLimiter limiter_{limits(), health_};
  const int sled_ = simulation_.find_body("sled");
  std::vector<AppliedCommand> applied_;

  std::vector<mpm::MotionLimits> limits() const {
    std::vector<mpm::MotionLimits> limits;
    for (const mpm::CommandDefinition& commanded : scene_.commands) limits.push_back(commanded.limits);
    return limits;
  }
  const mpm::RigidBody& sled() const { return simulation_.rigid_body(sled_); }
  double x() const { return sled().pose().position.x() - 0.02; }

  AppliedCommand velocity(double vx) const {
    AppliedCommand command;
    command.body = sled_;
    command.twist.linear.x() = vx;
    command.effect = simulation_.time();
    return command;
  }
  AppliedCommand pose(double x, double z, double seconds) const {
    AppliedCommand command;
    command.body = sled_;
    command.kind = CommandKind::pose;
    command.pose = sled().definition().pose;
    command.pose.position += mpm::Vec3(x, 0.0, z);
    command.effect = simulation_.time();
    command.arrival = simulation_.time() + std::llround(seconds * 1e9);
    return command;
  }
  /// Advances by one sync period and returns the number of commands that it applied.
  std::size_t advance() {
    const std::vector<AppliedCommand> commands = limiter_.next(simulation_);
    for (const AppliedCommand& command : commands) {
      apply(command, simulation_);
      applied_.push_back(command);
    }
    simulation_.advance();
    return commands.size();
  }
  /// Velocities of the sled along x over the next periods, in steps of 0.04 m/s.
  std::vector<double> steps(int periods) {
    std::vector<double> found;
    for (int i = 0; i < periods; ++i) {
      advance();
      found.push_back(sled().twist().linear.x() / 0.04);
    }
    return found;
  }
  static void expect_near(const std::vector<double>& found, const std::vector<double>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-9) << "period " << i;
  }
  std::string diagnostic(const std::string& key) const {
    diagnostic_updater::DiagnosticStatusWrapper status;
    health_.fill_commands(status);
    if (key == "message") return status.message;
    for (const diagnostic_msgs::KeyValue& value : status.values) {
      if (value.key == key) return value.value;
    }
    return "";
  }
};

TEST_F(Limiter, VelocityIsARampToTheSpeedThatIsAllowed) {
  ASSERT_TRUE(limiter_.take(velocity(1.0), simulation_));
  // 1 m/s is commanded and 0.4 m/s allowed: ten steps of 0.04 m/s.
  expect_near(steps(12), {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 10, 10});
  EXPECT_EQ(applied_.size(), 10U);  // after that no command is needed
  // 0.04 m/s times 2 ms times 55, and two periods at full speed.
  EXPECT_NEAR(x(), 0.04 * kPeriod * (55.0 + 20.0), kRound);
  EXPECT_EQ(diagnostic("limited of sled"), "1");  // one command
  // Commanded to turn back, it slows down first.
  ASSERT_TRUE(limiter_.take(velocity(-0.04), simulation_));
  expect_near(steps(12), {9, 8, 7, 6, 5, 4, 3, 2, 1, 0, -1, -1});
  EXPECT_EQ(diagnostic("limited of sled"), "2");
}

TEST_F(Limiter, VelocityWithinTheLimitsIsAppliedAsItIs) {
  ASSERT_TRUE(limiter_.take(velocity(0.03), simulation_));
  EXPECT_EQ(advance(), 1U);
  EXPECT_EQ(applied_[0].twist.linear.x(), 0.03);
  EXPECT_EQ(advance(), 0U);
  EXPECT_EQ(diagnostic("limited of sled"), "");
}

TEST_F(Limiter, BrakingSpeedLeadsToRestInWholeSteps) {
  // A step of speed is 0.04 m/s, 80 um in a period. Braking from n steps takes 1 + ... + n of these.
  const double unit = 0.04 * kPeriod;
  EXPECT_NEAR(braking_speed(unit * 1.0, 20.0, kPeriod), 0.04 * 1.0, 1e-15);
  EXPECT_NEAR(braking_speed(unit * 10.0, 20.0, kPeriod), 0.04 * 4.0, 1e-15);
  // 3.75 steps, then 2.75, 1.75 and 0.75: 9 in all.
  EXPECT_NEAR(braking_speed(unit * 9.0, 20.0, kPeriod), 0.04 * 3.75, 1e-15);
  EXPECT_NEAR(braking_speed(unit * 0.5, 20.0, kPeriod), 0.04 * 0.5, 1e-15);
  EXPECT_EQ(braking_speed(0.1, mpm::MotionLimits::kNone, kPeriod), 0.1 / kPeriod);
  EXPECT_EQ(braking_speed(0.0, 20.0, kPeriod), 0.0);
}

TEST_F(Limiter, PoseIsReachedLateAndAtRest) {
  // A pose 10 of those units away, commanded for the next period.
  ASSERT_TRUE(limiter_.take(pose(10.0 * 0.04 * kPeriod, 0.0, kPeriod), simulation_));
  // By hand, in steps of speed: the lesser of one more than before and the speed from which it can stop within the
  // units that are left, which are 10, 9, 7, 4, 5/3, 1/3.
  expect_near(steps(7), {1, 2, 3, 7.0 / 3.0, 4.0 / 3.0, 1.0 / 3.0, 0});
  EXPECT_EQ(applied_.size(), 6U);
  EXPECT_EQ(x(), (sled().definition().pose.position.x() + 10.0 * 0.04 * kPeriod) - 0.02);  // exactly there
  EXPECT_EQ(applied_.back().requested, ros::Time());
}

TEST_F(Limiter, ABodyThatIsBehindItsPoseSaysSo) {
  // 8 mm in 10 ms is twice the allowed speed: after 10 ms it has moved by 0.04 m/s times 2 ms times 15, 1.2 mm.
  ASSERT_TRUE(limiter_.take(pose(0.008, 0.0, 5 * kPeriod), simulation_));
  for (int i = 0; i < 5; ++i) advance();
  EXPECT_EQ(std::stod(diagnostic("behind [m] of sled")), 0.0);
  advance();  // the pose is due: the sync point reports the lag
  EXPECT_EQ(std::stod(diagnostic("behind [m] of sled")), 0.0068);
  EXPECT_NE(diagnostic("message").find("'sled' is behind its pose by 0.0068 m"), std::string::npos)
      << diagnostic("message");
  for (int i = 0; i < 60; ++i) advance();
  EXPECT_NEAR(x(), 0.008, kRound);
  EXPECT_EQ(std::stod(diagnostic("behind [m] of sled")), 0.0);
  EXPECT_EQ(diagnostic("message").find("behind"), std::string::npos);
}

TEST_F(Limiter, APoseIsReachedAsSoonAsLimitsAllow) {
  // 25 units in ten periods. By hand: the body makes up for the delay at the start (22 units in eight periods are 2.75
  // a period), and keeps one step at the end for braking.
  ASSERT_TRUE(limiter_.take(pose(25.0 * 0.04 * kPeriod, 0.0, 10 * kPeriod), simulation_));
  expect_near(steps(12), {1, 2, 2.75, 2.75, 2.75, 2.75, 2.75, 2.75, 2.75, 1.875, 0.875, 0});
}

TEST_F(Limiter, NothingIsExceededWhateverIsAsked) {
  std::mt19937_64 dice(11);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(dice); };
  mpm::Twist before;
  for (int i = 0; i < 300; ++i) {
    if (i % 20 == 0) {
      AppliedCommand command = pose(uniform(0.0, 0.1), uniform(-0.03, 0.0), uniform(kPeriod, 0.1));
      command.pose.orientation = Eigen::AngleAxisd(uniform(-1.0, 1.0), mpm::Vec3::UnitY());
      if (dice() % 2 == 0) command = velocity(uniform(-2.0, 2.0));
      command.twist.angular.y() = uniform(-50.0, 50.0);
      limiter_.take(command, simulation_);
    }
    advance();
    const mpm::Twist& now = sled().twist();
    // Twists are computed from poses, whose round-off is divided by 2 ms.
    EXPECT_LE(now.linear.norm(), 0.4 + 1e-9);
    EXPECT_LE(now.angular.norm(), 5.0 + 1e-9);
    EXPECT_LE((now.linear - before.linear).norm(), 0.04 + 1e-9);
    EXPECT_LE((now.angular - before.angular).norm(), 1.0 + 1e-9);
    before = now;
  }
}

TEST_F(Limiter, WhatWasAppliedReplaysWithoutTheLimiter) {
  mpm::Simulation replayed(mpm::build(scene_), {1});
  ASSERT_TRUE(limiter_.take(pose(0.01, -0.02, kPeriod), simulation_));
  for (int i = 0; i < 15; ++i) advance();
  ASSERT_TRUE(limiter_.take(velocity(0.4), simulation_));
  for (int i = 0; i < 15; ++i) advance();
  auto next = applied_.begin();
  while (replayed.time() < simulation_.time()) {
    for (; next != applied_.end() && next->effect == replayed.time(); ++next) apply(*next, replayed);
    replayed.advance();
  }
  EXPECT_EQ(next, applied_.end());
  EXPECT_EQ(replayed.state_hash(), simulation_.state_hash());
}

TEST_F(Limiter, WhatAPlaneDoesNotHaveIsNoGoal) {
  // The pose of a robot's link beside the plane, slightly tilted.
  AppliedCommand command = pose(0.0001, 0.0, kPeriod);
  command.pose.position.y() = 0.3;
  command.pose.orientation = Eigen::AngleAxisd(0.1, mpm::Vec3::UnitX());
  ASSERT_TRUE(limiter_.take(command, simulation_));
  for (int i = 0; i < 10; ++i) advance();
  EXPECT_TRUE(limiter_.goals().empty());
  EXPECT_NEAR(x(), 0.0001, kRound);
}

TEST_F(Limiter, WhatTheBodyWouldRefuseIsRefusedAtOnce) {
  const mpm::Scene scene = mpm::load_scene(data_file("drive.yaml"), {"rigid_bodies.sled.free={mass: 1 kg, axes: [z]}"});
  mpm::Simulation simulation(mpm::build(scene), {1});
  CommandLimiter limiter(limits(), health_);
  ASSERT_TRUE(limiter.take(velocity(0.1), simulation));
  EXPECT_THROW(limiter.take(pose(0.01, 0.0, kPeriod), simulation), mpm::RigidError);  // a free body takes no pose
  // The present ramp continues by 0.04 m/s a period, along the axis that is prescribed.
  const std::vector<AppliedCommand> next = limiter.next(simulation);
  ASSERT_EQ(next.size(), 1U);
  EXPECT_NEAR(next[0].twist.linear.x(), 0.04, kRound);
}

TEST_F(Limiter, ABodyWithoutLimitsIsLeftAlone) {
  AppliedCommand command = velocity(0.1);
  command.body = simulation_.find_body("probe");
  EXPECT_FALSE(limiter_.take(command, simulation_));
  EXPECT_TRUE(limiter_.next(simulation_).empty());
  EXPECT_TRUE(limiter_.goals().empty());
}

TEST_F(Limiter, GoalsCanBeSavedAndTakenAgain) {
  limiter_.take(pose(0.01, 0.0, kPeriod), simulation_);
  advance();
  CommandLimiter again(limits(), health_);
  for (const AppliedCommand& goal : limiter_.goals()) again.take(goal, simulation_);
  const std::vector<AppliedCommand> one = limiter_.next(simulation_), other = again.next(simulation_);
  ASSERT_EQ(one.size(), 1U);
  ASSERT_EQ(other.size(), 1U);
  EXPECT_EQ(one[0].pose.position, other[0].pose.position);
  limiter_.drop(sled_);
  EXPECT_TRUE(limiter_.goals().empty());
}

TEST(Limits, OfAccelerationAloneDoNotLetAWildVelocityPass) {
  const mpm::Scene scene = mpm::load_scene(data_file("drive.yaml"), {"rigid_bodies.sled.limits={acceleration: 20}"});
  const mpm::Simulation simulation(mpm::build(scene), {1});
  NodeHealth health;
  std::vector<mpm::MotionLimits> limits;
  for (const mpm::CommandDefinition& commanded : scene.commands) limits.push_back(commanded.limits);
  CommandLimiter limiter(limits, health);
  AppliedCommand wild;
  wild.body = simulation.find_body("sled");
  wild.twist.linear.x() = 1e6;
  EXPECT_THROW(limiter.take(wild, simulation), mpm::RigidError);
  EXPECT_TRUE(limiter.goals().empty());
}

}  // namespace command_limiter_test
}  // namespace mpm_ros
