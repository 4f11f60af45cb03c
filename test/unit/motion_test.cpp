// Motion of a rigid body: exact for constant twist; pose from twist and twist from poses are inverse to each other.
#include "mpm/rigid/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mpm/math/constants.hpp"

namespace mpm {
namespace motion_test {

using mpm::kPi;

/// Angle between two orientations [rad]; from the chord of the quaternions, which is precise near zero.
double angle_between(const Quat& a, const Quat& b) {
  const double chord = std::min((a.coeffs() - b.coeffs()).norm(), (a.coeffs() + b.coeffs()).norm());
  return 4.0 * std::asin(std::min(1.0, 0.5 * chord));
}

struct Random {
  std::mt19937 engine{7};
  std::uniform_real_distribution<double> uniform{-1.0, 1.0};
  Vec3 vector() { return {uniform(engine), uniform(engine), uniform(engine)}; }
  Quat orientation() { return Quat(uniform(engine), uniform(engine), uniform(engine), uniform(engine)).normalized(); }
};

TEST(Motion, QuarterTurnAboutWorldZ) {
  // By hand: a turn of 90 degrees about z takes x to y, and the origin moves on a straight line.
  Pose pose;
  pose.position = {1.0, 2.0, 3.0};
  const Twist twist{{0.5, 0.0, -1.0}, {0.0, 0.0, kPi}};
  const Pose after = integrate(pose, twist, 0.5);
  EXPECT_LT((after.position - Vec3(1.25, 2.0, 2.5)).norm(), 1e-15);
  EXPECT_LT((after.orientation * Vec3::UnitX() - Vec3::UnitY()).norm(), 4e-16);
}

TEST(Motion, RotationRateIsInWorldAxes) {
  // The body's z axis lies along world x; a turn about world z takes it to world y. If the rate were in body axes, the
  // axis would stay where it is.
  Pose pose;
  pose.orientation = Quat(Eigen::AngleAxisd(0.5 * kPi, Vec3::UnitY()));
  const Pose after = integrate(pose, {Vec3::Zero(), {0.0, 0.0, 0.5 * kPi}}, 1.0);
  EXPECT_LT((after.orientation * Vec3::UnitZ() - Vec3::UnitY()).norm(), 1e-15);
}

TEST(Motion, MatchesRodriguesFormula) {
  // Rotation of a vector about an axis: Eigen's AngleAxis matrix, a different formula from the quaternion product.
  Random random;
  for (int i = 0; i < 200; ++i) {
    const Pose pose{random.vector(), random.orientation()};
    const Twist twist{random.vector(), 5.0 * random.vector()};
    const double dt = 0.7;
    const Mat3 turn = Eigen::AngleAxisd(dt * twist.angular.norm(), twist.angular.normalized()).toRotationMatrix();
    const Pose after = integrate(pose, twist, dt);
    // 1e-14: some forty operations on numbers of size one.
    EXPECT_LT((after.orientation.toRotationMatrix() - turn * pose.orientation.toRotationMatrix()).norm(), 1e-14);
  }
}

TEST(Motion, TwistBetweenIsTheInverse) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const Pose from{random.vector(), random.orientation()};
    const Pose to{random.vector(), random.orientation()};
    const double dt = 0.013;
    const Pose back = integrate(from, twist_between(from, to, dt), dt);
    EXPECT_LT((back.position - to.position).norm(), 1e-14);
    EXPECT_LT(angle_between(back.orientation, to.orientation), 1e-14);
  }
}

TEST(Motion, TwistIsRecovered) {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const Pose from{random.vector(), random.orientation()};
    const Twist twist{random.vector(), 1.8 * random.vector()};  // at most 1.8 sqrt(3) < pi in a second
    const Twist found = twist_between(from, integrate(from, twist, 1.0), 1.0);
    EXPECT_LT((found.linear - twist.linear).norm(), 1e-14);
    EXPECT_LT((found.angular - twist.angular).norm(), 1e-14);
  }
}

TEST(Motion, TinyAngles) {
  for (const double angle : {1e-3, 1e-7, 1e-8, 1e-9, 1e-10, 1e-100, 1e-300, 0.0}) {
    const Twist twist{Vec3::Zero(), {angle, -2.0 * angle, 0.0}};
    const Twist found = twist_between({}, integrate({}, twist, 1.0), 1.0);
    // The tolerance is relative: components of the quaternion have full precision however small they are.
    EXPECT_LE((found.angular - twist.angular).cwiseAbs().maxCoeff(), 1e-15 * angle) << angle;
  }
}

TEST(Motion, HalfTurn) {
  Random random;
  for (int i = 0; i < 100; ++i) {
    const Vec3 axis = random.vector().normalized();
    const Pose from{Vec3::Zero(), random.orientation()};
    const Pose to{Vec3::Zero(), Quat(Eigen::AngleAxisd(kPi, axis)) * from.orientation};
    const Twist twist = twist_between(from, to, 1.0);
    EXPECT_NEAR(twist.angular.norm(), kPi, 1e-14);
    EXPECT_LT(angle_between(integrate(from, twist, 1.0).orientation, to.orientation), 1e-14);
  }
}

TEST(Motion, TurnsTheShortWay) {
  // 350 degrees one way equal 10 degrees the other way.
  const Pose to{Vec3::Zero(), Quat(Eigen::AngleAxisd(350.0 * kPi / 180.0, Vec3::UnitZ()))};
  const Twist twist = twist_between({}, to, 2.0);
  EXPECT_LT((twist.angular - Vec3(0.0, 0.0, -0.5 * 10.0 * kPi / 180.0)).norm(), 1e-14);
  // The opposite quaternion is the same orientation, so there is no rotation.
  const Pose same{Vec3::Zero(), Quat(-1.0, 0.0, 0.0, 0.0)};
  EXPECT_EQ(twist_between({}, same, 1.0).angular.norm(), 0.0);
}

TEST(Motion, ManyStepsEqualOne) {
  Random random;
  const Pose start{random.vector(), random.orientation()};
  const Twist twist{random.vector(), 3.0 * random.vector()};
  Pose pose = start;
  for (int i = 0; i < 1000; ++i) pose = integrate(pose, twist, 1e-3);
  const Pose once = integrate(start, twist, 1.0);
  // 2e-13: a thousand steps, each with a rounding of at most an epsilon (2.2e-16).
  EXPECT_LT((pose.position - once.position).norm(), 2e-13);
  EXPECT_LT(angle_between(pose.orientation, once.orientation), 2e-13);
  EXPECT_NEAR(pose.orientation.norm(), 1.0, 1e-15);
}

TEST(Motion, VelocityOfAPointIsItsDerivative) {
  Random random;
  const Pose pose{random.vector(), random.orientation()};
  const Twist twist{random.vector(), random.vector()};
  const Vec3 body_point = random.vector();
  const double h = 1e-5;
  const Vec3 difference =
      (integrate(pose, twist, h).to_world(body_point) - integrate(pose, twist, -h).to_world(body_point)) / (2.0 * h);
  // 1e-9: central difference, h^2 / 6 times the third derivative (about 5) is 1e-10; rounding 1e-16 / 1e-5.
  EXPECT_LT((velocity_at(pose, twist, pose.to_world(body_point)) - difference).norm(), 1e-9);
}

TEST(Motion, WorldAndBodyPointsAreInverse) {
  Random random;
  const Pose pose{random.vector(), random.orientation()};
  const Vec3 point = random.vector();
  EXPECT_LT((pose.to_body(pose.to_world(point)) - point).norm(), 1e-15);
}

}  // namespace motion_test
}  // namespace mpm
