// Velocities in a body's own axes, from the message to what is applied at each sync point.
#include "mpm_ros/command/turning_twists.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mpm/math/constants.hpp"
#include "mpm_ros/command/command_reader.hpp"

namespace mpm_ros {
namespace turning_twists_test {

constexpr std::int64_t kSync = 10'000'000;  // [ns]

mpm::BodyState rover(double heading) {
  mpm::BodyState state;
  state.name = "rover";
  state.pose.orientation = Eigen::AngleAxisd(heading, mpm::Vec3::UnitZ());
  return state;
}

geometry_msgs::Twist forward_and_left(double speed, double rate) {
  geometry_msgs::Twist twist;
  twist.linear.x = speed;
  twist.angular.z = rate;
  return twist;
}

class OwnAxes : public testing::Test {
 protected:
  tf2::BufferCore frames_;
  NodeHealth health_;
  CommandQueue queue_{kSync};
  CommandReader reader_{{"rover"}, "world", "/bodies/", frames_, queue_, health_};
};

// 1 m/s ahead where ahead is the world's y; about z both are the same.
TEST_F(OwnAxes, AreTurnedToTheWorldsWhenTheCommandIsApplied) {
  reader_.take_own(0, forward_and_left(1.0, 0.5));
  const std::vector<DueCommand> due = queue_.take(0);
  ASSERT_EQ(due.size(), 1U);
  const AppliedCommand applied = in_world(due[0], {rover(mpm::kPi / 2.0)}, 0);
  EXPECT_NEAR((applied.twist.linear - mpm::Vec3::UnitY()).norm(), 0.0, 1e-15);
  EXPECT_NEAR((applied.twist.angular - mpm::Vec3(0.0, 0.0, 0.5)).norm(), 0.0, 1e-15);
  ASSERT_TRUE(applied.own);
  EXPECT_EQ(applied.own->linear, mpm::Vec3::UnitX());
  EXPECT_EQ(reader_.received(), 1U);
}

TEST_F(OwnAxes, OfAStampedMessageByTheNameOfItsFrameTurnTooThoseOfTheWorldDoNot) {
  geometry_msgs::TwistStamped stamped;
  stamped.twist = forward_and_left(1.0, 0.5);
  for (const std::string frame : {"rover", "world", ""}) {
    stamped.header.frame_id = frame;
    reader_.take(0, stamped);
    const std::vector<DueCommand> due = queue_.take(0);
    ASSERT_EQ(due.size(), 1U);
    EXPECT_EQ(in_world(due[0], {rover(0.1)}, 0).own.has_value(), frame == "rover") << frame;
  }
}

// A rover drives a circle of radius v / w, once around in 2 pi / w. By the directions of 628 sync points its way is a
// polygon, which closes to the part of a step that 2 pi is not of 628.
TEST_F(OwnAxes, TurnWithTheBodySoThatItDrivesACircle) {
  const double speed = 0.5, rate = 1.0, period = 0.01;
  TurningTwists turning;
  mpm::BodyState state = rover(0.3);
  const mpm::Twist own{{speed, 0.0, 0.0}, {0.0, 0.0, rate}};
  mpm::Twist world{state.pose.orientation * own.linear, own.angular};
  turning.hold(0, own, state.pose.orientation);
  double farthest = 0.0;
  const int around = 628;
  for (int i = 0; i < around; ++i) {
    const std::vector<AppliedCommand> commands = turning.next({state}, i * kSync);
    ASSERT_EQ(commands.size(), i == 0 ? 0U : 1U);  // it was applied at the first by itself
    if (!commands.empty()) {
      EXPECT_EQ(commands[0].effect, i * kSync);
      world = commands[0].twist;
    }
    EXPECT_NEAR(world.linear.norm(), speed, 1e-12);
    state.pose = mpm::integrate(state.pose, world, period);
    farthest = std::max(farthest, state.pose.position.norm());
  }
  EXPECT_NEAR(farthest, 2.0 * speed / rate, 1e-4);  // across; a polygon's corners are beside it by (w dt)^2 / 24
  EXPECT_LT(state.pose.position.norm(), speed * period);
  turning.drop(0);
  EXPECT_TRUE(turning.next({rover(0.0)}, kSync).empty());
}

TEST_F(OwnAxes, OfABodyThatDoesNotTurnAreAppliedOnce) {
  TurningTwists turning;
  turning.hold(0, {{1.0, 0.0, 0.0}, {}}, rover(0.3).pose.orientation);
  EXPECT_TRUE(turning.next({rover(0.3)}, kSync).empty());
}

// A sender's numbers 5, 6, 9: two have not come; one that starts again begins anew.
TEST_F(OwnAxes, GapsInTheNumbersOfASenderAreCounted) {
  geometry_msgs::TwistStamped stamped;
  for (const std::uint32_t seq : {5U, 6U, 9U, 0U, 1U}) {
    stamped.header.seq = seq;
    reader_.take(0, stamped, "/a");
    reader_.take(0, stamped, "/b");
  }
  EXPECT_EQ(reader_.missing(), 4U);
}

}  // namespace turning_twists_test
}  // namespace mpm_ros
