// Conversions, stamps and clouds, against values computed by hand.
#include "mpm_ros/message/conversions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "mpm/scene/scene.hpp"
#include "mpm_ros/message/contact_average.hpp"
#include "mpm_ros/message/particle_cloud.hpp"
#include "mpm_ros/message/quantities.hpp"
#include "mpm_ros/message/stamps.hpp"

namespace mpm_ros {
namespace conversions_test {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

geometry_msgs::Pose pose_message(double w, double x, double y, double z) {
  geometry_msgs::Pose pose;
  pose.orientation.w = w;
  pose.orientation.x = x;
  pose.orientation.y = y;
  pose.orientation.z = z;
  return pose;
}

TEST(Conversions, TwistKeepsEveryBit) {
  geometry_msgs::Twist message;
  message.linear.x = 0.1;
  message.linear.y = -0.2;
  message.linear.z = 1.0 / 3.0;
  message.angular.x = 4.0;
  message.angular.y = 5.0;
  message.angular.z = -6.0;
  EXPECT_EQ(to_message(from_message(message)), message);
}

TEST(Conversions, PoseKeepsTheOrderOfTheQuaternion) {
  const geometry_msgs::Pose message = pose_message(0.5, 0.1, -0.5, 0.7);
  const mpm::Pose pose = from_message(message);
  EXPECT_EQ(pose.orientation.w(), 0.5);
  EXPECT_EQ(pose.orientation.z(), 0.7);
  EXPECT_EQ(to_message(pose), message);
}

TEST(Conversions, NonFiniteComponentsAreNamed) {
  geometry_msgs::Twist twist;
  EXPECT_EQ(problem_of(twist), "");
  twist.angular.y = kNaN;
  EXPECT_EQ(problem_of(twist), "angular.y is nan");
  twist.linear.z = kInfinity;
  EXPECT_EQ(problem_of(twist), "linear.z is inf");

  geometry_msgs::Pose pose = pose_message(1.0, 0.0, 0.0, 0.0);
  EXPECT_EQ(problem_of(pose), "");
  pose.position.x = -kInfinity;
  EXPECT_EQ(problem_of(pose), "position.x is -inf");
  pose = pose_message(kNaN, 0.0, 0.0, 0.0);
  EXPECT_EQ(problem_of(pose), "orientation.w is nan");
}

TEST(Conversions, QuaternionIsNormalisedWithinOneThousandthAndRefusedBeyond) {
  EXPECT_EQ(problem_of(pose_message(1.0009, 0.0, 0.0, 0.0)), "");
  EXPECT_EQ(problem_of(pose_message(0.9991, 0.0, 0.0, 0.0)), "");
  EXPECT_NE(problem_of(pose_message(1.0011, 0.0, 0.0, 0.0)), "");
  EXPECT_NE(problem_of(pose_message(0.9989, 0.0, 0.0, 0.0)), "");
  EXPECT_NE(problem_of(pose_message(0.0, 0.0, 0.0, 0.0)), "");
  // One division and one square root: an error of a few units in the last place.
  EXPECT_NEAR(checked_pose(pose_message(1.0009, 0.0, 0.0, 0.0)).orientation.norm(), 1.0, 1e-15);
}

TEST(Conversions, WrenchInBodyAxes) {
  // Turned by 90 degrees about z, the body's x axis is the world's y: a world force along y is along the body's x.
  const mpm::Quat turned(std::cos(M_PI / 4.0), 0.0, 0.0, std::sin(M_PI / 4.0));
  const mpm::Wrench wrench = in_body_axes({{0.0, 3.0, 0.5}, {2.0, 0.0, 0.0}}, turned);
  EXPECT_TRUE(wrench.force.isApprox(mpm::Vec3(3.0, 0.0, 0.5), 1e-15));
  EXPECT_TRUE(wrench.torque.isApprox(mpm::Vec3(0.0, -2.0, 0.0), 1e-15));
}

TEST(Conversions, TransformsNameTheBodies) {
  mpm::BodyState body;
  body.name = "blade";
  body.pose.position = {1.0, 2.0, 3.0};
  const tf2_msgs::TFMessage message = to_transforms({body}, "world", ros::Time(5, 6));
  ASSERT_EQ(message.transforms.size(), 1U);
  EXPECT_EQ(message.transforms[0].header.frame_id, "world");
  EXPECT_EQ(message.transforms[0].child_frame_id, "blade");
  EXPECT_EQ(message.transforms[0].header.stamp, ros::Time(5, 6));
  EXPECT_EQ(message.transforms[0].transform.translation.z, 3.0);
  EXPECT_EQ(message.transforms[0].transform.rotation.w, 1.0);
}

/// Every number of a list reads the same in the report and in the message.
template <class Report, class Message>
void expect_same(const Report& report, const Message& message,
                 const std::vector<Quantity<Report, Message>>& quantities) {
  for (const Quantity<Report, Message>& one : quantities) {
    if (!one.of_report) continue;
    EXPECT_EQ(one.of_report(report), one.of_message(message)) << one.name;
  }
}

TEST(Conversions, ContactForceThereAndBack) {
  mpm::ContactReport report;
  report.body = "blade";
  report.mean = {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  report.peak = {{7.0, 8.0, 9.0}, {-1.0, -2.0, -3.0}};
  report.interval = 0.25;
  report.nodes = 12;
  report.impulse = {0.5, 0.0, -0.5};
  report.area = 0.375;
  report.friction_energy = 2.25;
  report.pressing = 11.0;
  report.friction = {0.125, 0.25, 0.5};
  report.per_radian = {0.75, 0.0, -1.5};
  report.origin = {10.0, 20.0, 30.0};
  report.arm = {0.5, -0.25, 0.125};
  const ContactForce message = to_message(report);
  EXPECT_EQ(message.centre_of_pressure.x, 10.5);
  EXPECT_EQ(message.centre_of_pressure.y, 19.75);
  EXPECT_EQ(message.centre_of_pressure.z, 30.125);
  EXPECT_EQ(message.contact_area, 0.375);
  EXPECT_EQ(message.friction_energy, 2.25);
  EXPECT_EQ(message.nodes, 12U);
  EXPECT_EQ(message.per_radian.z, -1.5);
  EXPECT_EQ(message.arm.y, -0.25);
  EXPECT_EQ(message.peak.torque.z, -3.0);
  expect_same(report, message, contact_quantities());
  mpm::ContactReport again;
  for (const ContactQuantity& one : contact_quantities()) {
    if (one.set_report) one.set_report(again, one.of_message(message));
  }
  again.origin = report.origin;  // in no message: the body's pose
  expect_same(again, message, contact_quantities());
}

mpm::PairReport pair_report() {
  mpm::PairReport report;
  report.name = "block/slab";
  report.force = {1.0, 2.0, -3.0};
  report.friction = {1.0, 2.0, 0.0};
  report.pressing = 3.0;
  report.area = 0.25;
  report.interval = 0.5;
  report.nodes = 9;
  report.impulse = {0.5, 1.0, -1.5};
  report.friction_energy = 0.125;
  report.interface_energy = 0.0625;
  report.centre = {4.0, 5.0, 6.0};
  return report;
}

TEST(Conversions, ContactPairThereAndBack) {
  const ContactPair message = to_message(pair_report());
  EXPECT_EQ(message.name, "block/slab");
  EXPECT_EQ(message.force.z, -3.0);
  EXPECT_EQ(message.friction.y, 2.0);
  EXPECT_EQ(message.pressing, 3.0);
  EXPECT_EQ(message.contact_area, 0.25);
  EXPECT_EQ(message.interval, 0.5);
  EXPECT_EQ(message.nodes, 9U);
  EXPECT_EQ(message.impulse.z, -1.5);
  EXPECT_EQ(message.friction_energy, 0.125);
  EXPECT_EQ(message.interface_energy, 0.0625);
  EXPECT_EQ(message.centre_of_pressure.x, 4.0);
  expect_same(pair_report(), message, pair_quantities());
}

TEST(Conversions, NothingPressedStaysNotANumber) {
  const ContactForce message = to_message(mpm::ContactReport());
  EXPECT_TRUE(std::isnan(message.centre_of_pressure.x));
  EXPECT_EQ(message.pressing, 0.0);
  EXPECT_TRUE(std::isnan(message.arm.z));
}

TEST(Conversions, SolverStateKeepsItsNumbers) {
  mpm::SolverState state;
  state.time = 1'500'000'000;
  state.step.steps = 7;
  state.energy.add("plastic", mpm::NamedEnergy::Kind::dissipated, 2.5);
  state.energy.add("friction", mpm::NamedEnergy::Kind::dissipated, 3.5);
  state.energy.add("pair_friction", mpm::NamedEnergy::Kind::dissipated, 4.5);
  state.energy.add("interface", mpm::NamedEnergy::Kind::stored, 5.5);
  state.energy.add("heat", mpm::NamedEnergy::Kind::stored, 1.5);  // energy of a module that no list knows
  state.numbers.push_back({"returned", "1", 6.0});
  state.audit.impulses.push_back({"gravity", {0.0, 0.0, -9.0}});
  const SolverState message = to_message(state);
  EXPECT_EQ(message.time, 1.5);
  EXPECT_EQ(message.steps, 7U);
  EXPECT_EQ(message.energy_plastic, 2.5);
  EXPECT_EQ(message.energy_friction, 3.5);
  EXPECT_EQ(message.energy_pair_friction, 4.5);
  EXPECT_EQ(message.energy_interface, 5.5);
  EXPECT_EQ(message.particles_returned, 6U);
  expect_same(state, message, state_quantities());
  ASSERT_EQ(message.values.size(), 3U);
  EXPECT_EQ(message.values[0].name, "energy total");
  EXPECT_EQ(message.values[0].value, std::vector<double>{7.0});
  EXPECT_EQ(message.values[1].name, "heat");
  EXPECT_EQ(message.values[1].unit, "J");
  EXPECT_EQ(message.values[1].value, std::vector<double>{1.5});
  ASSERT_EQ(message.impulses.size(), 1U);
  EXPECT_EQ(message.impulses[0].name, "gravity");
  EXPECT_EQ(message.impulses[0].impulse.z, -9.0);
}

TEST(Conversions, HashHasSixteenDigits) { EXPECT_EQ(hash_text(0xabcU), "0000000000000abc"); }

TEST(Stamps, CountFromTheOrigin) {
  const Stamps stamps(ros::Time(100, 999'999'999));
  EXPECT_EQ(stamps.at(1), ros::Time(101, 0));
  EXPECT_EQ(stamps.time_of(ros::Time(101, 0)), 1);
  EXPECT_EQ(stamps.time_of(ros::Time(99, 999'999'999)), -1'000'000'000);
}

TEST(Stamps, NothingIsStampedZero) {
  const Stamps stamps;
  EXPECT_EQ(stamps.at(0), ros::TIME_MIN);
  EXPECT_EQ(stamps.time_of(ros::TIME_MIN), 0);
  EXPECT_EQ(stamps.at(2'000'000'003), ros::Time(2, 3));
}

TEST(ParticleCloud, IsPackedInOrderOfId) {
  sensor_msgs::PointCloud2 cloud;
  fill_cloud({"vx"}, {{0, 2, 4}, {{0, 2, 4}, {10, 12, 14}, {20, 22, 24}, {30, 32, 34}}}, cloud);
  ASSERT_EQ(cloud.width, 3U);
  ASSERT_EQ(cloud.point_step, 20U);
  ASSERT_EQ(cloud.data.size(), 60U);
  ASSERT_EQ(cloud.fields.size(), 5U);
  EXPECT_EQ(cloud.fields[3].name, "id");
  EXPECT_EQ(cloud.fields[3].datatype, sensor_msgs::PointField::UINT32);
  EXPECT_EQ(cloud.fields[4].name, "vx");
  EXPECT_EQ(cloud.fields[4].offset, 16U);
  struct Point {
    float x, y, z;
    std::uint32_t id;
    float vx;
  } last;
  std::memcpy(&last, cloud.data.data() + 40, sizeof(last));
  EXPECT_EQ(last.x, 4.0F);
  EXPECT_EQ(last.y, 14.0F);
  EXPECT_EQ(last.z, 24.0F);
  EXPECT_EQ(last.id, 4U);
  EXPECT_EQ(last.vx, 34.0F);
}

TEST(ParticleCloud, RefusesAnUnknownField) {
  EXPECT_EQ(problem_of(ParticleSelection{{"vx"}, {}}), "");
  EXPECT_NE(problem_of(ParticleSelection{{"vxx"}, {}}).find("'vxx'"), std::string::npos);
  EXPECT_NE(problem_of(ParticleSelection{{"vx", "vx"}, {}}), "");
  EXPECT_NE(problem_of(ParticleSelection{{"x"}, {}}), "");
  EXPECT_NE(problem_of(ParticleSelection{{}, {0, {}}}), "");
}

TEST(ParticleCloud, TakesTheFieldsOfEveryShippedScene) {
  for (const auto& [name, line] : mpm::shipped_scenes()) {
    const mpm::OutputDefinition output = mpm::load_scene(name).output;
    EXPECT_EQ(problem_of(ParticleSelection{output.particle_fields, {output.particle_stride, output.particle_region}}),
              "")
        << name;
  }
}

mpm::ContactReport contact(double force, double peak, double interval, double impulse) {
  mpm::ContactReport report;
  report.body = "blade";
  report.mean.force.x() = force;
  report.peak.force.x() = peak;
  report.interval = interval;
  report.impulse.x() = impulse;
  report.per_radian = {force, 0.0, -force};
  report.area = 0.5 * force;
  report.friction_energy = 2.0 * impulse;
  return report;
}

TEST(ContactAverage, IsImpulseOverTime) {
  ContactAverage average;
  average.add({{contact(0.0, 0.0, 0.0, 0.0)}, {}});  // the report at time zero covers no time
  average.add({{contact(4.0, 5.0, 1.0, 4.0)}, {}});
  average.add({{contact(1.0, 2.0, 3.0, 7.0)}, {}});
  const std::vector<mpm::ContactReport> taken = average.take().bodies;
  ASSERT_EQ(taken.size(), 1U);
  // (4 N x 1 s + 1 N x 3 s) / 4 s
  EXPECT_DOUBLE_EQ(taken[0].mean.force.x(), 1.75);
  EXPECT_DOUBLE_EQ(taken[0].per_radian.x(), 1.75);
  EXPECT_DOUBLE_EQ(taken[0].per_radian.z(), -1.75);
  EXPECT_EQ(taken[0].peak.force.x(), 5.0);
  EXPECT_EQ(taken[0].interval, 4.0);
  EXPECT_EQ(taken[0].impulse.x(), 7.0);
  EXPECT_DOUBLE_EQ(taken[0].area, 0.875);  // (2 m^2 x 1 s + 0.5 m^2 x 3 s) / 4 s
  EXPECT_EQ(taken[0].friction_energy, 14.0);
  EXPECT_TRUE(average.take().bodies.empty());
}

mpm::ContactReport pressed(double pressing, double interval, double arm, double origin) {
  mpm::ContactReport report;
  report.body = "blade";
  report.interval = interval;
  report.pressing = pressing;
  report.friction.y() = pressing;
  report.origin.x() = origin;
  if (pressing > 0.0) report.arm = {arm, 0.0, 0.0};
  return report;
}

TEST(ContactAverage, ArmsGoByTheNormalImpulse) {
  ContactAverage average;
  average.add({{pressed(0.0, 1.0, 0.0, 1.0)}, {}});  // nothing pressed: no arm
  average.add({{pressed(6.0, 1.0, 2.0, 2.0)}, {}});  // 6 N s
  average.add({{pressed(1.0, 2.0, 6.0, 3.0)}, {}});  // 2 N s
  average.add({{pressed(0.0, 4.0, 0.0, 4.0)}, {}});  // nothing again, but the body moved on
  const std::vector<mpm::ContactReport> taken = average.take().bodies;
  // (6 x 2 m + 2 x 6 m) / 8 from the present position of the body
  EXPECT_EQ(taken[0].centre_of_pressure(), mpm::Vec3(7.0, 0.0, 0.0));
  EXPECT_EQ(taken[0].pressing, 1.0);  // 8 N s in 8 s
  EXPECT_EQ(taken[0].friction.y(), 1.0);
}

TEST(ContactAverage, NothingPressedHasNoCentre) {
  ContactAverage average;
  average.add({{pressed(0.0, 1.0, 0.0, 1.0)}, {}});
  average.add({{pressed(0.0, 1.0, 0.0, 1.0)}, {}});
  EXPECT_FALSE(average.take().bodies[0].centre_of_pressure().allFinite());
}

TEST(ContactAverage, JoinsPairsAsItDoesBodies) {
  mpm::PairReport first = pair_report();  // 3 N for 0.5 s at (4, 5, 6) m
  mpm::PairReport apart = first;          // then nothing for a second
  apart.force.setZero();
  apart.friction.setZero();
  apart.pressing = apart.area = 0.0;
  apart.interval = 1.0;
  apart.nodes = 0;
  apart.centre = mpm::PairReport().centre;
  mpm::PairReport last = first;  // 1 N for 0.5 s elsewhere
  last.force = {0.0, 0.0, -1.0};
  last.pressing = 1.0;
  last.area = 0.5;
  last.nodes = 4;
  last.impulse = {0.5, 1.0, -2.0};
  last.friction_energy = 0.25;
  last.interface_energy = 0.03125;
  last.centre = {8.0, 5.0, 6.0};
  ContactAverage average;
  for (const mpm::PairReport& report : {first, apart, last}) average.add({{}, {report}});
  const std::vector<mpm::PairReport> taken = average.take().pairs;
  ASSERT_EQ(taken.size(), 1U);
  EXPECT_EQ(taken[0].force, mpm::Vec3(0.25, 0.5, -1.0));  // (0.5, 1, -1.5) + (0, 0, -0.5) N s in 2 s
  EXPECT_EQ(taken[0].friction, mpm::Vec3(0.5, 1.0, 0.0));
  EXPECT_EQ(taken[0].pressing, 1.0);
  EXPECT_EQ(taken[0].interval, 2.0);
  EXPECT_EQ(taken[0].centre, mpm::Vec3(5.0, 5.0, 6.0));  // (1.5 x 4 m + 0.5 x 8 m) / 2
  EXPECT_EQ(taken[0].area, 0.5);
  EXPECT_EQ(taken[0].nodes, 4);
  EXPECT_EQ(taken[0].impulse.z(), -2.0);
  EXPECT_EQ(taken[0].friction_energy, 0.25);
  EXPECT_EQ(taken[0].interface_energy, 0.03125);
}

}  // namespace conversions_test
}  // namespace mpm_ros
