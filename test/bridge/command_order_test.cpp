// The order in which commands are applied must not depend on their time of arrival, where stamps allow it. Sync points
// are 10 ns apart here.
#include <gtest/gtest.h>

#include <algorithm>

#include "mpm_ros/command/command_queue.hpp"

namespace mpm_ros {
namespace command_order_test {

BodyCommand velocity(double vx, const std::string& sender, std::optional<std::int64_t> stamp) {
  BodyCommand command;
  command.twist.linear.x() = vx;
  command.sender = sender;
  command.stamp = stamp;
  return command;
}

std::vector<double> speeds(const std::vector<DueCommand>& due) {
  std::vector<double> values;
  for (const DueCommand& command : due) values.push_back(command.command.twist.linear.x());
  return values;
}

using Speeds = std::vector<double>;

TEST(CommandOrder, OfEqualStampsTheSendersNameDecides) {
  const std::vector<BodyCommand> commands{velocity(1.0, "/a", 10), velocity(2.0, "/b", 10), velocity(3.0, "/c", 10)};
  std::vector<int> arrival{0, 1, 2};
  do {
    CommandQueue queue(10);
    for (const int i : arrival) queue.push(commands[i]);
    EXPECT_EQ(speeds(queue.take(10)), (Speeds{1.0, 2.0, 3.0}));
  } while (std::next_permutation(arrival.begin(), arrival.end()));
}

TEST(CommandOrder, WhatOneSenderSaidLastIsAppliedLast) {
  CommandQueue queue(10);
  queue.push(velocity(2.0, "/a", 10));
  queue.push(velocity(5.0, "/b", 10));
  queue.push(velocity(1.0, "/a", 10));
  EXPECT_EQ(speeds(queue.take(10)), (Speeds{2.0, 1.0, 5.0}));
}

TEST(CommandOrder, TheStampComesBeforeTheSender) {
  CommandQueue queue(10);
  queue.push(velocity(1.0, "/a", 9));
  queue.push(velocity(2.0, "/b", 8));
  EXPECT_EQ(speeds(queue.take(10)), (Speeds{2.0, 1.0}));
}

TEST(CommandOrder, WhatCameLateFollowsInTheOrderOfArrival) {
  CommandQueue queue(10);
  queue.take(0);
  queue.push(velocity(1.0, "/c", {}));
  queue.push(velocity(2.0, "/b", 0));  // past
  queue.push(velocity(3.0, "/a", {}));
  queue.push(velocity(4.0, "/d", 10));
  EXPECT_EQ(speeds(queue.take(10)), (Speeds{4.0, 1.0, 2.0, 3.0}));
}

TEST(CommandOrder, WhatComesOnHoldWaitsOutside) {
  CommandQueue queue(10);
  queue.push(velocity(1.0, "/a", 10));
  queue.hold();
  queue.push(velocity(2.0, "/a", 10));
  queue.push(velocity(3.0, "/a", 30));
  EXPECT_EQ(queue.waiting(), 3U);
  EXPECT_EQ(speeds(queue.take(10)), Speeds{1.0});
  EXPECT_TRUE(queue.take(20).empty());
  queue.release();
  EXPECT_EQ(queue.late().past, 1U);  // 10 ns had passed when it was accepted
  EXPECT_EQ(speeds(queue.take(30)), (Speeds{3.0, 2.0}));
  queue.push(velocity(4.0, "/a", {}));
  EXPECT_EQ(speeds(queue.take(40)), Speeds{4.0});
}

TEST(CommandOrder, ANewRunForgetsWhatWaitsOutside) {
  CommandQueue queue(10);
  queue.hold();
  queue.push(velocity(1.0, "/a", 10));
  queue.clear();
  queue.release();
  EXPECT_TRUE(queue.take(10).empty());
}

}  // namespace command_order_test
}  // namespace mpm_ros
