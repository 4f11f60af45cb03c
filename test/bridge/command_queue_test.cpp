// Time at which a command takes effect, in which order, and which other commands it ends. Sync points are 10 ns apart
// here.
#include "mpm_ros/command/command_queue.hpp"

#include <gtest/gtest.h>

#include "mpm_ros/command/command_watch.hpp"

namespace mpm_ros {
namespace command_queue_test {

BodyCommand velocity(int body, double vx, std::optional<std::int64_t> stamp = {}) {
  BodyCommand command;
  command.body = body;
  command.twist.linear.x() = vx;
  command.stamp = stamp;
  return command;
}

BodyCommand pose(int body, double x, std::optional<std::int64_t> stamp = {}) {
  BodyCommand command;
  command.body = body;
  command.kind = CommandKind::pose;
  command.pose.position.x() = x;
  command.stamp = stamp;
  return command;
}

std::vector<double> speeds(const std::vector<DueCommand>& due) {
  std::vector<double> values;
  for (const DueCommand& command : due) values.push_back(command.command.twist.linear.x());
  return values;
}

using Speeds = std::vector<double>;

TEST(CommandQueue, VelocityWithoutStampTakesEffectAtTheNextSyncPoint) {
  CommandQueue queue(10);
  queue.take(0);
  queue.push(velocity(0, 1.0));
  EXPECT_EQ(speeds(queue.take(10)), Speeds{1.0});
  EXPECT_TRUE(queue.take(20).empty());
  EXPECT_EQ(queue.late().past + queue.late().unstamped, 0U);
}

TEST(CommandQueue, StampedVelocityWaitsForTheFirstSyncPointAtOrAfterItsStamp) {
  CommandQueue queue(10);
  queue.push(velocity(0, 1.0, 11));
  queue.push(velocity(0, 2.0, 10));
  EXPECT_TRUE(queue.take(0).empty());
  EXPECT_EQ(speeds(queue.take(10)), Speeds{2.0});
  EXPECT_EQ(queue.waiting(), 1U);
  EXPECT_EQ(speeds(queue.take(20)), Speeds{1.0});
  EXPECT_EQ(queue.late().past + queue.late().unstamped, 0U);
}

TEST(CommandQueue, NoMoreOfABodyWaitForTheirStampsThanTheBound) {
  CommandQueue queue(10);
  queue.take(0);
  for (std::size_t i = 0; i < CommandQueue::kMost; ++i) {
    ASSERT_TRUE(queue.push(velocity(0, 1.0, 1000 + static_cast<std::int64_t>(i))));
  }
  EXPECT_FALSE(queue.push(velocity(0, 2.0, 999)));
  queue.hold();
  EXPECT_FALSE(queue.push(velocity(0, 2.0, 999)));
  EXPECT_FALSE(queue.push_past_hold(velocity(0, 2.0, 999)));
  queue.release();
  EXPECT_EQ(queue.waiting(), CommandQueue::kMost);
  EXPECT_EQ(queue.take(1000).size(), 1U);
  EXPECT_TRUE(queue.push(velocity(0, 2.0, 1001)));
  EXPECT_FALSE(queue.push(velocity(0, 2.0, 1001)));
}

// Whatever waits, a stop without a stamp, or with one that is past, is taken and applied at the next sync point.
TEST(CommandQueue, AStopIsTakenBesideAnyNumberOfStampedCommands) {
  CommandQueue queue(10);
  queue.take(0);
  for (std::size_t i = 0; i < CommandQueue::kMost; ++i) {
    ASSERT_TRUE(queue.push(velocity(0, 1.0, 1000 + static_cast<std::int64_t>(i))));
  }
  EXPECT_TRUE(queue.push(velocity(0, 0.0)));
  EXPECT_TRUE(queue.push(velocity(0, 0.25, 0)));
  EXPECT_TRUE(queue.push(velocity(1, 0.5)));
  EXPECT_TRUE(queue.push(velocity(1, 2.0, 1000)));
  EXPECT_EQ(speeds(queue.take(10)), (Speeds{0.0, 0.25, 0.5}));
}

// In a pause a stream without stamps goes on: its last command is the one that holds. Another sender's, of the same
// body, stays. On hold the same.
TEST(CommandQueue, TheOldestWithoutAStampMakesRoom) {
  for (const bool on_hold : {false, true}) {
    CommandQueue queue(10);
    queue.take(0);
    BodyCommand other = velocity(0, -1.0);
    other.sender = "/other";
    EXPECT_TRUE(queue.push(other));
    if (on_hold) queue.hold();
    constexpr std::size_t kBeyond = 20;
    for (std::size_t i = 0; i < CommandQueue::kMost + kBeyond; ++i) {
      ASSERT_TRUE(queue.push(velocity(0, static_cast<double>(i))));
    }
    queue.release();
    EXPECT_EQ(queue.waiting(), CommandQueue::kMost + 1);
    EXPECT_EQ(queue.dropped(), kBeyond);
    const Speeds applied = speeds(queue.take(10));
    ASSERT_EQ(applied.size(), CommandQueue::kMost + 1);
    EXPECT_EQ(applied[0], -1.0);
    EXPECT_EQ(applied[1], static_cast<double>(kBeyond));
    EXPECT_EQ(applied.back(), static_cast<double>(CommandQueue::kMost + kBeyond - 1));
    EXPECT_TRUE(queue.push(velocity(0, 0.0)));
    EXPECT_EQ(queue.waiting(), 1U);
  }
}

// Poses that are far away are not looked at in each sync point; the answer must not depend on them. Those of two
// seconds, given at once in any order, arrive one after the other at their stamps.
TEST(CommandQueue, AWayGivenAheadIsFollowedPoseByPose) {
  constexpr std::int64_t kSync = 10'000'000, kEnd = 2'000'000'000;
  CommandQueue queue(kSync);
  std::vector<std::int64_t> stamps;
  for (std::int64_t stamp = 3 * kSync; stamp <= kEnd; stamp += 3 * kSync) stamps.push_back(stamp);
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const std::int64_t stamp = stamps[(7 * i) % stamps.size()];  // 66 of them: each once
    queue.push(pose(0, static_cast<double>(stamp), stamp));
  }
  std::size_t next = 0;
  for (std::int64_t now = 0; now < kEnd; now += kSync) {
    for (const DueCommand& due : queue.take(now)) {
      ASSERT_LT(next, stamps.size());
      EXPECT_EQ(due.arrival, stamps[next]);
      EXPECT_EQ(now, next == 0 ? 0 : stamps[next - 1]);  // it sets out when the one before has arrived
      ++next;
    }
  }
  EXPECT_EQ(next, stamps.size());
}

TEST(CommandQueue, PastStampIsAppliedAtTheNextSyncPointAndCounted) {
  CommandQueue queue(10);
  queue.take(0);
  queue.take(10);
  queue.push(velocity(0, 1.0, 10));  // the sync point at 10 has passed
  queue.push(velocity(0, 2.0, 11));
  EXPECT_EQ(queue.late().past, 1U);
  BodyCommand unstamped = velocity(0, 3.0);
  unstamped.late = true;  // as a message with stamp zero on a stamped topic
  CommandQueue other(10);
  other.push(unstamped);
  EXPECT_EQ(other.late().unstamped, 1U);
  EXPECT_EQ(other.late().past, 0U);
  // Effective times are 20 (late: now) and 11: the late one is applied last.
  EXPECT_EQ(speeds(queue.take(20)), (Speeds{2.0, 1.0}));
}

TEST(CommandQueue, OrderIsEffectiveTimeThenBodyThenArrival) {
  CommandQueue queue(10);
  queue.take(0);
  queue.push(velocity(1, 1.0, 9));
  queue.push(velocity(1, 2.0, 5));
  queue.push(velocity(1, 3.0, 5));
  queue.push(velocity(0, 4.0, 5));
  queue.push(velocity(0, 5.0));
  EXPECT_EQ(speeds(queue.take(10)), (Speeds{4.0, 2.0, 3.0, 1.0, 5.0}));
}

TEST(CommandQueue, PoseToComeArrivesAtItsStampRoundedUp) {
  CommandQueue queue(10);
  queue.push(pose(0, 1.0, 33));
  const std::vector<DueCommand> due = queue.take(0);
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(due[0].arrival, 40);
}

TEST(CommandQueue, PosesToComeFollowEachOther) {
  CommandQueue queue(10);
  queue.push(pose(0, 3.0, 60));
  queue.push(pose(0, 1.0, 20));
  queue.push(pose(0, 2.0, 40));
  std::vector<std::pair<std::int64_t, std::int64_t>> effect_and_arrival;
  for (std::int64_t now = 0; now < 100; now += 10) {
    for (const DueCommand& due : queue.take(now)) effect_and_arrival.emplace_back(now, due.arrival);
  }
  EXPECT_EQ(effect_and_arrival, (std::vector<std::pair<std::int64_t, std::int64_t>>{{0, 20}, {20, 40}, {40, 60}}));
}

TEST(CommandQueue, EarlierPoseTakesThePlaceOfTheOneUnderWay) {
  CommandQueue queue(10);
  queue.push(pose(0, 1.0, 100));
  EXPECT_EQ(queue.take(0).size(), 1U);
  queue.push(pose(0, 2.0, 50));
  const std::vector<DueCommand> due = queue.take(10);
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(due[0].arrival, 50);
}

TEST(CommandQueue, LatePosesArriveOneCommandPeriodLater) {
  CommandQueue queue(10);
  queue.take(0);
  queue.push(pose(0, 1.0, 0));
  std::vector<DueCommand> due = queue.take(10);
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(due[0].arrival, 20);  // the period is not known yet: one sync period
  queue.take(20);
  queue.take(30);
  queue.push(pose(0, 2.0, 30));
  due = queue.take(40);
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(due[0].arrival, 70);  // the stamps are 30 apart
}

TEST(CommandQueue, PosesWithoutStampTakeTheirPeriodFromTheSyncPoints) {
  CommandQueue queue(10);
  queue.take(0);
  queue.push(pose(0, 1.0));
  queue.take(10);
  queue.take(20);
  queue.push(pose(0, 2.0));
  const std::vector<DueCommand> due = queue.take(30);
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(due[0].arrival, 50);  // their motions begin at 10 and at 30
}

TEST(CommandQueue, VelocityEndsThePosesReceivedBeforeIt) {
  CommandQueue queue(10);
  queue.push(pose(0, 1.0, 20));
  queue.push(pose(0, 2.0, 40));
  queue.push(pose(1, 9.0, 40));  // for another body
  queue.take(0);
  queue.push(velocity(0, 1.0));
  EXPECT_EQ(speeds(queue.take(10)), Speeds{1.0});
  EXPECT_EQ(queue.waiting(), 0U);
  EXPECT_TRUE(queue.take(20).empty());
}

TEST(CommandQueue, TheKindReceivedLastWinsAtOneSyncPoint) {
  CommandQueue queue(10);
  queue.push(pose(0, 1.0, 50));
  queue.push(velocity(0, 1.0));
  std::vector<DueCommand> due = queue.take(0);
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(due[0].command.kind, CommandKind::velocity);

  queue.push(velocity(0, 2.0));
  queue.push(pose(0, 1.0, 50));
  due = queue.take(10);
  ASSERT_EQ(due.size(), 2U);
  EXPECT_EQ(due[1].command.kind, CommandKind::pose);
}

TEST(CommandQueue, PoseEndsAVelocityThatWaits) {
  CommandQueue queue(10);
  queue.push(velocity(0, 1.0, 100));
  queue.push(pose(0, 1.0, 50));
  EXPECT_EQ(queue.take(0).size(), 1U);
  EXPECT_EQ(queue.waiting(), 0U);
}

TEST(CommandWatch, NamesEachSilenceOnce) {
  CommandWatch watch(50);
  EXPECT_TRUE(watch.silent(1000).empty());  // no body was commanded
  AppliedCommand command;
  command.body = 3;
  command.effect = 100;
  watch.heard(command);
  EXPECT_TRUE(watch.silent(149).empty());
  const std::vector<Silence> silent = watch.silent(150);
  ASSERT_EQ(silent.size(), 1U);
  EXPECT_EQ(silent[0].body, 3);
  EXPECT_FALSE(silent[0].wrench);
  EXPECT_TRUE(watch.silent(160).empty());
}

TEST(CommandWatch, APoseIsHeardOfUntilItsArrival) {
  CommandWatch watch(50);
  AppliedCommand command;
  command.effect = 100;
  command.arrival = 300;
  watch.heard(command);
  EXPECT_TRUE(watch.silent(349).empty());
  EXPECT_EQ(watch.silent(350).size(), 1U);
}

TEST(CommandWatch, WrenchesDoNotHideThatMotionsCeased) {
  CommandWatch watch(50);
  AppliedCommand motion;
  motion.effect = 100;
  watch.heard(motion);
  AppliedCommand wrench = motion;
  wrench.kind = CommandKind::wrench;
  wrench.effect = 140;
  watch.heard(wrench);
  const std::vector<Silence> motions = watch.silent(150);
  ASSERT_EQ(motions.size(), 1U);
  EXPECT_FALSE(motions[0].wrench);
  const std::vector<Silence> wrenches = watch.silent(190);
  ASSERT_EQ(wrenches.size(), 1U);
  EXPECT_TRUE(wrenches[0].wrench);
}

TEST(CommandWatch, ZeroMeansNever) {
  CommandWatch watch(0);
  watch.heard(AppliedCommand());
  EXPECT_TRUE(watch.silent(1'000'000'000'000).empty());
}

TEST(CommandQueue, WhatIsLookedUpInAStepIsNotHeld) {
  CommandQueue queue(10);
  queue.hold();
  queue.push(velocity(0, 1.0));
  queue.push_past_hold(pose(1, 2.0));
  const std::vector<DueCommand> due = queue.take(0);
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(due[0].command.body, 1);
  queue.release();
  EXPECT_EQ(speeds(queue.take(10)), Speeds{1.0});
}

}  // namespace command_queue_test
}  // namespace mpm_ros
