// Transforms of a tf frame as pose commands: by their stamps, each once, and the report while there is none.
#include "mpm_ros/command/frame_follower.hpp"

#include <gtest/gtest.h>

namespace mpm_ros {
namespace frame_follower_test {

constexpr std::int64_t kSync = 10'000'000;  // [ns]

class Follower : public testing::Test {
 protected:
  tf2::BufferCore frames_;
  NodeHealth health_;
  CommandQueue queue_{kSync};
  CommandReader reader_{{"plate", "probe"}, "world", "/bodies/", frames_, queue_, health_};
  FrameFollower follower_{{"", "tool0"}, "world", frames_, reader_, health_};

  void SetUp() override { reader_.set_frame(1, "tool0"); }

  void transform(double x, double stamp, const std::string& parent = "world", const std::string& child = "tool0",
                 bool constant = false) {
    geometry_msgs::TransformStamped message;
    message.header.frame_id = parent;
    message.header.stamp = ros::Time(stamp);
    message.child_frame_id = child;
    message.transform.translation.x = x;
    message.transform.rotation.w = 1.0;
    ASSERT_TRUE(frames_.setTransform(message, "test", constant));
  }
  /// Commands that are due at the sync point of that number.
  std::vector<DueCommand> at(int sync) {
    follower_.look(Stamps().at((sync + 1) * kSync));
    return queue_.take(sync * kSync);
  }
  std::string diagnostic() const {
    diagnostic_updater::DiagnosticStatusWrapper status;
    health_.fill_commands(status);
    return status.message;
  }
};

// One stamp of another clock must not stand for the newest command for ever.
TEST_F(Follower, AStampThatIsRefusedIsNotTheNewest) {
  geometry_msgs::TwistStamped command;
  command.header.stamp = ros::Time(1.0);
  reader_.take(0, command);
  command.header.stamp = ros::Time(1e4);
  reader_.take(0, command);
  EXPECT_EQ(health_.refused(), 1U);
  EXPECT_EQ(reader_.newest().stamp, 1'000'000'000);
}

TEST_F(Follower, WaitsForTheFrameAndSaysSo) {
  EXPECT_TRUE(at(0).empty());
  EXPECT_NE(diagnostic().find("'probe' waits for the tf frame 'tool0'"), std::string::npos) << diagnostic();
  transform(0.5, 0.004);
  const std::vector<DueCommand> due = at(1);
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(due[0].command.body, 1);
  EXPECT_EQ(due[0].command.kind, CommandKind::pose);
  EXPECT_EQ(due[0].command.pose.position.x(), 0.5);
  EXPECT_EQ(due[0].command.requested, ros::Time(0.004));
  EXPECT_EQ(diagnostic(), "commands are applied as they come");
  EXPECT_EQ(health_.refused(), 0U);
}

TEST_F(Follower, ATransformIsTakenOnceAndReachedOnePeriodLater) {
  transform(0.1, 0.005);
  EXPECT_EQ(at(1).size(), 1U);
  EXPECT_TRUE(at(2).empty());
  transform(0.2, 0.025);  // 20 ms after the one before, which is the period
  const std::vector<DueCommand> due = at(3);
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(due[0].arrival, 5 * kSync);
}

TEST_F(Follower, AFrameThatIsStampedAheadIsFollowedToEachSyncPoint) {
  transform(0.0, 0.0001);
  transform(1.0, 0.1001);  // 10 m/s
  for (int sync = 0; sync < 9; ++sync) {
    const std::vector<DueCommand> due = at(sync);
    ASSERT_EQ(due.size(), 1U) << sync;
    EXPECT_EQ(due[0].arrival, (sync + 1) * kSync);
    EXPECT_NEAR(due[0].command.pose.position.x(), 10.0 * ((sync + 1) * 0.01 - 0.0001), 1e-12) << sync;
  }
  EXPECT_EQ(queue_.late().past, 0U);
  // The last part of the motion ends after that sync point: there is a command for the last stamp, and then none.
  EXPECT_EQ(at(9).size(), 1U);
  const std::vector<DueCommand> last = at(10);
  ASSERT_EQ(last.size(), 1U);
  EXPECT_EQ(last[0].command.pose.position.x(), 1.0);
  EXPECT_TRUE(at(11).empty());
}

TEST_F(Follower, ChainsOfFramesAndStaticOnesAreFollowed) {
  transform(1.0, 0.0, "world", "base", true);
  transform(0.5, 0.0, "base", "tool0", true);
  for (int sync = 0; sync < 3; ++sync) {
    const std::vector<DueCommand> due = at(sync);
    ASSERT_EQ(due.size(), 1U);  // a body with a prescribed pose receives a command
    EXPECT_EQ(due[0].command.pose.position.x(), 1.5);
  }
}

TEST_F(Follower, OtherCommandsForABodyThatFollowsAreRefused) {
  reader_.take(1, geometry_msgs::Twist());
  EXPECT_EQ(health_.refused(), 1U);
  EXPECT_NE(diagnostic().find("it follows the tf frame 'tool0' (drive: tf)"), std::string::npos) << diagnostic();
  mpm_ros::Command command;
  command.body = "probe";
  command.kind = mpm_ros::Command::VELOCITY;
  std::string problem;
  reader_.read(command, problem);
  EXPECT_NE(problem.find("it follows the tf frame 'tool0'"), std::string::npos) << problem;
  reader_.take(0, geometry_msgs::Twist());  // the plate follows no frame
  EXPECT_EQ(health_.refused(), 1U);
}

TEST_F(Follower, ATransformThatIsNoPoseIsRefused) {
  geometry_msgs::PoseStamped pose;
  pose.header.stamp = ros::Time(0.005);
  reader_.follow(1, pose);  // its quaternion is zero
  EXPECT_EQ(health_.refused(), 1U);
  EXPECT_TRUE(queue_.take(0).empty());
}

TEST_F(Follower, BeginsAgainWithTheRun) {
  transform(0.1, 0.005);
  EXPECT_EQ(at(1).size(), 1U);
  queue_.clear();
  follower_.clear();
  EXPECT_EQ(at(1).size(), 1U);
}

TEST_F(Follower, TransformsOfBeforeTheClockWasSetBackAreNotFollowed) {
  transform(0.1, 99.99);
  follower_.clear();
  EXPECT_TRUE(at(0).empty());
  EXPECT_NE(diagnostic().find("stamped 99.980 s ahead"), std::string::npos) << diagnostic();
  frames_.clear();  // as a reset does
  transform(0.2, 0.005);
  const std::vector<DueCommand> due = at(1);
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(due[0].command.pose.position.x(), 0.2);
}

TEST_F(Follower, ARunThatBeginsAgainSaysAgainThatItWaits) {
  at(0);
  follower_.clear();
  health_.restart();
  at(0);
  EXPECT_NE(diagnostic().find("'probe' waits for the tf frame 'tool0'"), std::string::npos) << diagnostic();
}

// A robot whose clock is five seconds ahead, as that of a wall is of a slow run.
TEST_F(Follower, TheLatestIsFollowedWhateverItsStampAndMarked) {
  FrameFollower latest({"", "tool0"}, "world", frames_, reader_, health_, true);
  transform(0.1, 5.0);
  const auto due_at = [&](int sync) {
    latest.look(Stamps().at((sync + 1) * kSync));
    return queue_.take(sync * kSync);
  };
  std::vector<DueCommand> due = due_at(0);
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(due[0].command.pose.position.x(), 0.1);
  EXPECT_EQ(due[0].arrival, kSync);  // as a pose without a stamp: one sync period, with no stream before it
  const AppliedCommand applied = in_world(due[0], {}, 0);
  EXPECT_TRUE(applied.stamp_ignored);
  EXPECT_EQ(applied.requested, ros::Time(5.0));
  EXPECT_TRUE(due_at(1).empty());  // each once
  transform(0.2, 5.1);
  EXPECT_EQ(due_at(2).size(), 1U);
  EXPECT_EQ(latest.farthest_ahead(ros::Time(0.03)).first, 0.0);  // nothing waits for it
  EXPECT_EQ(queue_.late().past + queue_.late().unstamped, 0U);
}

TEST_F(Follower, KnowsHowFarAFrameIsAhead) {
  EXPECT_EQ(follower_.farthest_ahead(ros::Time(0.01)).first, 0.0);  // not known yet
  transform(0.1, 0.02);
  transform(0.2, 0.53);
  const auto [ahead, frame] = follower_.farthest_ahead(ros::Time(0.03));
  EXPECT_NEAR(ahead, 0.5, 1e-9);
  EXPECT_EQ(frame, "tool0");
}

// A ros::Duration holds 68 years; the difference of these is more.
TEST_F(Follower, StampsOfFarClocksAreNoMistake) {
  transform(0.1, 4e9);
  EXPECT_TRUE(at(0).empty());
  EXPECT_NE(diagnostic().find("s ahead"), std::string::npos) << diagnostic();
}

}  // namespace frame_follower_test
}  // namespace mpm_ros
