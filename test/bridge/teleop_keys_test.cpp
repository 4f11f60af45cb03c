// Keys as velocity commands: which, for how long, and what stops them.
#include "mpm_ros/command/teleop_keys.hpp"

#include <gtest/gtest.h>

namespace mpm_ros {
namespace teleop_keys_test {

constexpr double kSpeed = 0.2, kRate = 0.4, kHold = 0.7;

class Keys : public testing::Test {
 protected:
  TeleopKeys keys_{kSpeed, kRate, kHold};
  bool still(double now) const {
    const mpm::Twist twist = keys_.twist(now);
    return twist.linear.isZero(0.0) && twist.angular.isZero(0.0);
  }
};

TEST_F(Keys, EachMovesAlongOrAboutAnAxis) {
  const std::string forwards = "warliu", backwards = "sdfjko";
  for (int axis = 0; axis < 6; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      TeleopKeys keys(kSpeed, kRate, kHold);
      EXPECT_EQ(keys.press((sign > 0.0 ? forwards : backwards)[static_cast<std::size_t>(axis)], 0.0),
                TeleopKeys::Action::move);
      const mpm::Twist twist = keys.twist(0.0);
      for (int other = 0; other < 6; ++other) {
        const double found = other < 3 ? twist.linear[other] : twist.angular[other - 3];
        EXPECT_EQ(found, other != axis ? 0.0 : sign * (axis < 3 ? kSpeed : kRate)) << axis << " " << other;
      }
    }
  }
}

TEST_F(Keys, CountForAWhileAndShorterOnceTheyRepeat) {
  keys_.press('w', 1.0);
  EXPECT_FALSE(still(1.0 + 0.99 * kHold));
  EXPECT_TRUE(still(1.0 + kHold));
  // The keyboard repeats after 0.5 s, every 30 ms.
  keys_.press('w', 2.0);
  for (int i = 0; i < 10; ++i) keys_.press('w', 2.5 + 0.03 * i);
  EXPECT_FALSE(still(2.77 + 0.99 * TeleopKeys::kRepeated));
  EXPECT_TRUE(still(2.77 + 1.01 * TeleopKeys::kRepeated));
}

TEST_F(Keys, AddUpAndTurnBack) {
  keys_.press('w', 0.0);
  keys_.press('f', 0.1);
  EXPECT_EQ(keys_.twist(0.2).linear, mpm::Vec3(kSpeed, 0.0, -kSpeed));
  keys_.press('s', 0.2);
  EXPECT_EQ(keys_.twist(0.2).linear, mpm::Vec3(-kSpeed, 0.0, -kSpeed));
}

TEST_F(Keys, SpaceStopsAtOnce) {
  keys_.press('w', 0.0);
  keys_.press('u', 0.0);
  EXPECT_EQ(keys_.press(' ', 0.01), TeleopKeys::Action::stop);
  EXPECT_TRUE(still(0.01));
}

TEST_F(Keys, SpeedIsChangedByAQuarter) {
  keys_.press('+', 0.0);
  keys_.press('W', 0.0);
  EXPECT_EQ(keys_.twist(0.0).linear.x(), 1.25 * kSpeed);
  keys_.press('-', 0.0);
  keys_.press('-', 0.0);
  EXPECT_NEAR(keys_.twist(0.0).linear.x(), 0.8 * kSpeed, 1e-15);
  EXPECT_NE(keys_.status(0.0).find("a key: 0.16 m/s, 0.32 rad/s"), std::string::npos) << keys_.status(0.0);
}

TEST_F(Keys, OthersMeanNothing) {
  EXPECT_EQ(keys_.press('x', 0.0), TeleopKeys::Action::none);
  EXPECT_TRUE(still(0.0));
  EXPECT_EQ(keys_.press('q', 0.0), TeleopKeys::Action::quit);
}

}  // namespace teleop_keys_test
}  // namespace mpm_ros
