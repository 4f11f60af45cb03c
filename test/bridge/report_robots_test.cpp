// Robots in bag_report: tables, CSV, JSON, pictures, checks and comparison of an artificial arm with closed forms.
// Cost: 4 s.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mpm_ros/RobotStates.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mpm_ros/report/report.hpp"
#include "mpm_ros/report/temporary_folder.hpp"
#include "report_run.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace report_robots_test {

using nlohmann::json;
using test::HalfSineRun;
using test::kPi;

constexpr int kLast = HalfSineRun::kIntervals;

/// Angle of the elbow a quarter of a turn at its height, half way: q = pi/2 sin(pi t / T).
double angle(int index) { return 0.5 * kPi * std::sin(kPi * index / kLast); }

/// An elbow that turns there and back, and a slide that is pushed by an effort that falls from 5 N by 1 N in 10 ms.
RobotStates arm_at(int index) {
  RobotStates message;
  message.header.stamp.fromNSec(std::max<std::uint64_t>(1, static_cast<std::uint64_t>(index) * 1000000U));
  RobotState& arm = message.robots.emplace_back();
  arm.name = "arm";
  arm.base.orientation.w = 1.0;
  arm.joints = {"elbow", "slide"};
  arm.prismatic = {0, 1};
  arm.drive = {RobotState::POSITION, RobotState::EFFORT};
  arm.position = {angle(index), 0.001 * index};
  arm.velocity = {0.25 * index, 1.0};
  arm.effort = {-2.0 * index, 5.0 - 0.1 * index};
  arm.target = {angle(index), 5.0 - 0.1 * index};
  JointWrench& wrist = arm.sensors.emplace_back();
  wrist.joint = "wrist";
  wrist.link = "hand";
  wrist.wrench.force.z = 9.81 + (index == 40 ? 3.0 : 0.0);
  arm.energy_kinetic = 0.5;
  arm.energy_drive = 0.125 * index;
  return message;
}

class ReportRobots : public ::testing::Test {
 protected:
  /// `change`: called with each message before it is written.
  std::string bag_of(const std::string& name, const std::function<void(int, RobotState&)>& change = {}) const {
    rosbag::Bag bag(folder_.file(name), rosbag::bagmode::Write);
    HalfSineRun().write(bag);
    for (int i = 0; i <= kLast; ++i) {
      RobotStates message = arm_at(i);
      if (change) change(i, message.robots[0]);
      bag.write("/mpm/robots", message.header.stamp, message);
    }
    bag.close();
    return folder_.file(name);
  }
  std::string text_of(const ReportOptions& options) {
    std::ostringstream out, err;
    result_ = run_report(options, out, err, false);
    return out.str() + err.str();
  }
  std::vector<std::string> lines_of(const std::string& name) const {
    std::ifstream file(folder_.file(name));
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }

  TemporaryFolder folder_;
  ReportResult result_ = ReportResult::done;
};

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(ReportRobots, FiguresAreThoseOfTheClosedForms) {
  ReportOptions options;
  options.bags = {bag_of("run.bag")};
  options.json = "-";
  const json arm = json::parse(text_of(options)).at("robots").at("arm");
  const json& elbow = arm.at("joints").at("elbow");
  EXPECT_EQ(elbow.at("unit"), "rad");
  EXPECT_EQ(elbow.at("drive"), "position");
  EXPECT_EQ(elbow.at("position").at("start"), 0.0);
  EXPECT_NEAR(elbow.at("position").at("end"), 0.0, 1e-15);
  EXPECT_EQ(elbow.at("position").at("max"), angle(50));  // or 51, which is as near to the middle
  EXPECT_EQ(elbow.at("peak_velocity").at("value"), 0.25 * kLast);
  EXPECT_EQ(elbow.at("peak_effort").at("value"), -2.0 * kLast);
  EXPECT_EQ(elbow.at("peak_effort").at("time"), 0.101);
  const json& slide = arm.at("joints").at("slide");
  EXPECT_EQ(slide.at("unit"), "m");
  EXPECT_EQ(slide.at("effort").at("min"), 5.0 - 0.1 * kLast);
  EXPECT_EQ(slide.at("peak_effort").at("value"), 5.0 - 0.1 * kLast);  // -5.1 N, larger than the 5 N of the start
  EXPECT_EQ(arm.at("sensors").at("wrist").at("peak_force").at("size"), 12.81);
  EXPECT_EQ(arm.at("sensors").at("wrist").at("peak_force").at("time"), 0.04);
  EXPECT_EQ(arm.at("energy").at("start").at("drive"), 0.0);
  EXPECT_EQ(arm.at("energy").at("end").at("drive"), 0.125 * kLast);
}

TEST_F(ReportRobots, TablesHaveRobotsWhereThereAreAny) {
  ReportOptions options;
  options.bags = {bag_of("run.bag")};
  options.csv = folder_.file("tables");
  const std::string text = text_of(options);
  for (const char* part :
       {"Robots: joints", "arm/elbow", "effort [N m]", "effort [N] ", "Sensors", "12.81", "Energies of robots"})
    EXPECT_TRUE(holds(text, part)) << part << " not in:\n" << text;
  const std::vector<std::string> joints = lines_of("tables/joints.csv"), robots = lines_of("tables/robots.csv");
  ASSERT_EQ(joints.size(), kLast + 2U);
  EXPECT_EQ(
      joints[0],
      "time [s],arm/elbow position [rad],arm/elbow velocity [rad/s],arm/elbow effort [N m],arm/elbow target [rad],"
      "arm/slide position [m],arm/slide velocity [m/s],arm/slide effort [N],arm/slide target [N],"
      "arm/wrist fx [N],arm/wrist fy [N],arm/wrist fz [N],arm/wrist tx [N m],arm/wrist ty [N m],arm/wrist tz [N m]");
  EXPECT_EQ(joints[41], fmt::format("0.04,{},10,-80,{},0.04,1,1,1,0,0,12.81,0,0,0", angle(40), angle(40)));
  ASSERT_EQ(robots.size(), kLast + 2U);
  EXPECT_TRUE(holds(robots[0], "time [s],arm x [m],arm y [m],arm z [m],arm qx [1],")) << robots[0];
  EXPECT_TRUE(holds(robots[0], ",arm energy kinetic [J],")) << robots[0];
  EXPECT_EQ(robots[41], "0.04,0,0,0,0,0,0,1,0,0,0,0,0,0,0.5,0,5,0,0,0,0,0,0");

  HalfSineRun().write(folder_.file("none.bag"));
  options.bags = {folder_.file("none.bag")};
  options.csv = folder_.file("none");
  EXPECT_FALSE(holds(text_of(options), "obots"));
  EXPECT_FALSE(std::filesystem::exists(folder_.file("none/joints.csv")));
}

TEST_F(ReportRobots, JointsHaveAPicture) {
  ReportOptions options;
  options.bags = {bag_of("run.bag")};
  options.csv = folder_.file("tables");
  text_of(options);
  const std::string plots = folder_.file("plots");
  const std::string call =
      fmt::format("{} {} {}", source_file("scripts/plot_report.py"), folder_.file("tables"), plots);
  ASSERT_EQ(std::system(call.c_str()), 0);
  // More than a hundredth of it is not white, in more than one colour.
  const std::string look =
      "import sys, matplotlib.image as i; p = i.imread(sys.argv[1])[..., :3]; w = p.min(axis=2) < 0.95; "
      "sys.exit(0 if w.mean() > 0.01 and p[w].std() > 0.05 else 1)";
  EXPECT_EQ(std::system(fmt::format("/usr/bin/python3 -c '{}' {}/joints_arm.png", look, plots).c_str()), 0);
}

TEST_F(ReportRobots, ListsOfOtherLengthsAreRefused) {
  ReportOptions options;
  options.bags = {bag_of("run.bag", [](int i, RobotState& arm) {
    if (i == 3) arm.effort.pop_back();
  })};
  EXPECT_TRUE(holds(text_of(options), "/mpm/robots: 'arm' has 2 joints and 1 values of effort"));
  EXPECT_EQ(result_, ReportResult::bad_input);
}

TEST_F(ReportRobots, ACheckFindsWhatIsNotFinite) {
  ReportOptions options;
  options.check = true;
  options.bags = {bag_of("run.bag")};
  EXPECT_TRUE(holds(text_of(options), "PASS  robots"));
  options.bags = {bag_of("run.bag", [](int i, RobotState& arm) {
    if (i == 3) arm.velocity[1] = std::nan("");
  })};
  EXPECT_TRUE(holds(text_of(options), "FAIL  robots     at 0.003 s: arm/slide velocity is not finite"));
  EXPECT_EQ(result_, ReportResult::check_failed);
}

TEST_F(ReportRobots, AComparisonFindsTheJointThatDiffers) {
  ReportOptions options;
  options.same = true;
  options.bags = {bag_of("a.bag"), bag_of("b.bag", [](int i, RobotState& arm) {
                    if (i == 7) arm.position[0] *= 2.0;
                  })};
  EXPECT_TRUE(holds(text_of(options), "first difference: robots at 0.007 s: arm/elbow position"));
  EXPECT_EQ(result_, ReportResult::check_failed);
}

}  // namespace report_robots_test
}  // namespace mpm_ros
