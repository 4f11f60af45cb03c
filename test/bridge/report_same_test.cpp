// Comparison of two recordings: the first difference, to the bit, and the largest one with a tolerance.
#include "mpm_ros/report/report_same.hpp"

#include <gtest/gtest.h>
#include <mpm_ros/GlobalQuantities.h>

#include <sstream>

#include "mpm_ros/report/report.hpp"
#include "report_run.hpp"

namespace mpm_ros {
namespace report_same_test {

using test::HalfSineRun;

class ReportSame : public ::testing::Test {
 protected:
  /// Compares the unchanged run with `other`: returns the program's output and keeps its result.
  std::string said(const HalfSineRun& other, std::optional<double> tolerance = {}) {
    const std::string a = folder_.file("a.bag"), b = folder_.file("b.bag");
    HalfSineRun().write(a);
    other.write(b);
    ReportOptions options;
    options.bags = {a, b};
    options.same = true;
    options.tolerance = tolerance;
    std::ostringstream out, err;
    result_ = run_report(options, out, err, false);
    return out.str() + err.str();
  }

  TemporaryFolder folder_;
  ReportResult result_ = ReportResult::done;
};

TEST_F(ReportSame, ARunIsTheSameAsItselfAtAnotherHourAndSpeed) {
  HalfSineRun later;
  later.origin = ros::Time(1700000000, 0);
  later.name_space = "/other";
  later.on_state = [](int, SolverState& message) {
    message.real_time_factor = 7.0;
    return true;
  };
  EXPECT_NE(said(later).find("PASS  the same, to the bit"), std::string::npos);
  EXPECT_EQ(result_, ReportResult::done);
}

TEST_F(ReportSame, WhatTheMachineTookIsNotCompared) {
  ReportOptions options;
  options.same = true;
  GlobalQuantities message;
  message.header.stamp = ros::Time(0, 5000000);
  message.names = {"sxx", "elapsed time", "CPU time"};  // as written in the scene
  message.units = {"Pa", "s", "s"};
  const auto result = [&](const std::vector<double>& first, const std::vector<double>& second) {
    options.bags.clear();
    for (const auto& [name, values] : {std::pair("a.bag", first), std::pair("b.bag", second)}) {
      options.bags.push_back(folder_.file(name));
      rosbag::Bag bag(options.bags.back(), rosbag::bagmode::Write);
      HalfSineRun().write(bag);
      message.values = values;
      bag.write("/mpm/global_quantities", message.header.stamp, message);
    }
    std::ostringstream out, err;
    return run_report(options, out, err, false);
  };
  EXPECT_EQ(result({1.0, 2.0, 3.0}, {1.0, 4.0, 5.0}), ReportResult::done);
  options.tolerance = 0.01;
  EXPECT_EQ(result({1.0, 2.0, 3.0}, {1.0, 4.0, 5.0}), ReportResult::done);
  EXPECT_EQ(result({1.0, 2.0, 3.0}, {1.1, 2.0, 3.0}), ReportResult::check_failed);
}

TEST_F(ReportSame, TellsTheFirstBitThatDiffers) {
  HalfSineRun other;
  other.on_forces = [](int i, ContactForces& message) {
    if (i >= 50) message.bodies[0].wrench.force.x = std::nextafter(message.bodies[0].wrench.force.x, 1e9);
    return true;
  };
  other.on_particles = [](int i, sensor_msgs::PointCloud2& message) {
    const float moved = 0.25F;
    if (i == 3) std::memcpy(message.data.data() + 20, &moved, 4);  // x of the second particle, id 3, at 0.03 s
    return true;
  };
  std::string text = said(other);
  EXPECT_NE(text.find("first difference: particles at 0.03 s: x of particle 3: 0.00999999"), std::string::npos) << text;
  EXPECT_EQ(result_, ReportResult::check_failed);
  other.on_particles = [](int, sensor_msgs::PointCloud2&) { return true; };
  text = said(other);
  EXPECT_NE(text.find("first difference: contact_forces at 0.05 s: tool force x"), std::string::npos) << text;
}

TEST_F(ReportSame, FindsAMessageThatIsMissing) {
  HalfSineRun other;
  other.on_bodies = [](int i, BodyStates&) { return i != 7; };
  const std::string text = said(other);
  EXPECT_NE(text.find("bodies at 0.007 s: a message at 0.007 s and one at 0.008 s"), std::string::npos) << text;
  HalfSineRun shorter;
  shorter.on_state = [](int i, SolverState&) { return i < HalfSineRun::kIntervals; };
  EXPECT_NE(said(shorter).find("solver_state at 0.101 s: B has no more messages"), std::string::npos);
  EXPECT_EQ(result_, ReportResult::check_failed);
}

TEST_F(ReportSame, AToleranceCountsFromTheLargestSize) {
  // The largest mean force is nearly the amplitude, 40 N. 0.3 N are 0.75 % of it, whatever the force at that time.
  HalfSineRun other;
  other.on_forces = [](int i, ContactForces& message) {
    if (i == 2) message.bodies[0].wrench.force.y += 0.3;
    return true;
  };
  EXPECT_NE(said(other, 0.008).find("PASS  the same, within the tolerance"), std::string::npos);
  EXPECT_EQ(result_, ReportResult::done);
  const std::string text = said(other, 0.007);
  EXPECT_NE(text.find("FAIL  contact_forces"), std::string::npos) << text;
  EXPECT_NE(text.find("tool force y at 0.002 s"), std::string::npos) << text;
  EXPECT_NE(text.find("PASS  particles"), std::string::npos) << text;
  EXPECT_EQ(result_, ReportResult::check_failed);
}

TEST_F(ReportSame, ComparesTwoBagsOnly) {
  ReportOptions options;
  options.bags = {"a.bag"};
  options.same = true;
  std::ostringstream out, err;
  EXPECT_EQ(run_report(options, out, err, false), ReportResult::bad_input);
  EXPECT_NE(err.str().find("--same compares two bags, 1 given"), std::string::npos) << err.str();
  options.same = false;
  options.tolerance = 0.1;
  EXPECT_EQ(run_report(options, out, err, false), ReportResult::bad_input);
}

}  // namespace report_same_test
}  // namespace mpm_ros
