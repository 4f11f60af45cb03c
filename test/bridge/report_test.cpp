// bag_report on artificial runs: its tables and CSV files against closed forms, and its errors.
#include "mpm_ros/report/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "mpm_ros/message/bag_error.hpp"
#include "mpm_ros/report/report_bag.hpp"
#include "mpm_ros/report/report_csv.hpp"
#include "mpm_ros/report/report_plots.hpp"
#include "mpm_ros/report/report_statistics.hpp"
#include "report_run.hpp"

namespace mpm_ros {
namespace report_test {

using test::HalfSineRun;
using test::kPi;

/// Round-off of sums of about a hundred doubles.
constexpr double kRoundOff = 1e-13;

class ReportTest : public ::testing::Test {
 protected:
  std::string in_folder(const std::string& name) const { return folder_.path() + "/" + name; }

  std::string bag_of(const HalfSineRun& run) const {
    const std::string path = in_folder("run.bag");
    run.write(path);
    return path;
  }

  RunStatistics statistics_of(const HalfSineRun& run) const {
    RunBag bag(bag_of(run), "");
    RunStatistics statistics;
    bag.read({&statistics});
    return statistics;
  }

  /// Cells of a CSV file without quotes.
  std::vector<std::vector<std::string>> cells_of(const std::string& name) const {
    std::ifstream file(in_folder(name));
    EXPECT_TRUE(file) << name;
    std::vector<std::vector<std::string>> rows;
    for (std::string line; std::getline(file, line);) {
      rows.emplace_back();
      std::stringstream stream(line);
      for (std::string cell; std::getline(stream, cell, ',');) rows.back().push_back(cell);
    }
    return rows;
  }

  /// The number in a row of the column with this header.
  static double value(const std::vector<std::vector<std::string>>& rows, std::size_t row, const std::string& column) {
    const auto found = std::find(rows.front().begin(), rows.front().end(), column);
    if (found == rows.front().end()) {
      ADD_FAILURE() << "no column " << column;
      return std::numeric_limits<double>::quiet_NaN();
    }
    return std::stod(rows.at(row).at(static_cast<std::size_t>(found - rows.front().begin())));
  }

  TemporaryFolder folder_;
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(ReportTest, PeakIsTheMeanOverTheMiddleInterval) {
  const RunStatistics statistics = statistics_of({});
  const BodyStatistics& tool = statistics.body_statistics().at(0);
  // The mean of A sin(pi t / T) over an interval h about the middle is A (2 T / (pi h)) sin(pi h / (2 T)).
  const double h = HalfSineRun::kStep;
  const double width = HalfSineRun::kDuration;
  const double expected = HalfSineRun::kAmplitude * 2.0 * width / (kPi * h) * std::sin(kPi * h / (2.0 * width));
  EXPECT_NEAR(tool.of("force").peak.norm, expected, 1e-10 * expected);  // difference of impulses, divided by 1e-3 s
  EXPECT_EQ(tool.of("force").peak.time, 51000000);                      // the end of the 51st of 101 intervals
  EXPECT_NEAR(tool.of("peak force").peak.norm, 2.0 * expected, 1e-10 * expected);
  EXPECT_NEAR(tool.of("torque").peak.norm, 0.1 * expected, 1e-10 * expected);
  EXPECT_EQ(statistics.peak_time(), 51000000);
}

TEST_F(ReportTest, ImpulseAndMeanOfAHalfSine) {
  const BodyStatistics tool = statistics_of({}).body_statistics().at(0);
  const double impulse = 2.0 * HalfSineRun::kAmplitude * HalfSineRun::kDuration / kPi;  // the integral of a half sine
  EXPECT_NEAR(tool.of("impulse").end.x(), impulse, kRoundOff * impulse);
  EXPECT_NEAR(tool.of("force").integral.x(), impulse, kRoundOff * impulse);
  EXPECT_NEAR(tool.duration, HalfSineRun::kDuration, kRoundOff);
  EXPECT_EQ(tool.contact, std::make_pair(std::int64_t{1000000}, std::int64_t{101000000}));
}

TEST_F(ReportTest, RangeOfMotionAndTurn) {
  const BodyStatistics tool = statistics_of({}).body_statistics().at(0);
  EXPECT_DOUBLE_EQ(tool.range.min.x(), 0.0);
  EXPECT_DOUBLE_EQ(tool.range.max.x(), HalfSineRun::kSpeed * HalfSineRun::kDuration);
  EXPECT_DOUBLE_EQ(tool.range.max.z(), 0.3);
  // The angle comes from the dot product of quaternions: its error is the square root of round-off for small angles,
  // and smaller here.
  EXPECT_NEAR(tool.largest_turn, HalfSineRun::kTurnRate * HalfSineRun::kDuration, 1e-12);
}

TEST_F(ReportTest, TablesSayWhatTheRunWas) {
  ReportOptions options;
  options.bags = {bag_of({})};
  options.check = true;
  std::ostringstream out;
  EXPECT_TRUE(report(options, out, out, false));
  const std::string text = out.str();
  EXPECT_TRUE(contains(text, "half_sine"));
  EXPECT_TRUE(contains(text, "0.101 s")) << text;
  EXPECT_TRUE(contains(text, "1010, dt 0.0001 to 0.0001 s")) << text;
  EXPECT_TRUE(contains(text, "4; 11 snapshots of x y z id vx")) << text;
  EXPECT_TRUE(contains(text, "2.572")) << text;  // impulse 2 A T / pi [N s]
  EXPECT_TRUE(contains(text, "Gaps in time: none")) << text;
  EXPECT_FALSE(contains(text, "FAIL")) << text;
}

TEST_F(ReportTest, TablesDoNotDependOnTheStampOfTimeZero) {
  HalfSineRun run;
  run.origin = ros::Time(1700000000, 5);
  const RunStatistics statistics = statistics_of(run);
  EXPECT_EQ(statistics.peak_time(), 51000000);
}

TEST_F(ReportTest, CommandsAreCountedAndLateOnesToo) {
  const auto commands = statistics_of({}).commands();
  const CommandStatistics& tool = commands.at({"tool", "velocity"});
  EXPECT_EQ(tool.count, 1U);
  EXPECT_EQ(tool.first, 10000000);
  EXPECT_EQ(tool.late, 1U);  // stamped 8 ms, applied at 10 ms
}

TEST_F(ReportTest, CsvHasTheNumbersOfTheMessages) {
  ReportOptions options;
  options.bags = {bag_of({})};
  options.csv = in_folder("csv");
  options.snapshots = 3;
  std::ostringstream out;
  report(options, out, out, false);

  const auto forces = cells_of("csv/contact_forces.csv");
  ASSERT_EQ(forces.size(), 1U + 102U);
  EXPECT_EQ(value(forces, 51 + 1, "time [s]"), 0.051);
  EXPECT_EQ(value(forces, 51 + 1, "tool fx [N]"), HalfSineRun::mean(51 * 1e-3 - 1e-3, 51 * 1e-3));
  EXPECT_EQ(value(forces, 102, "tool impulse x [N s]"), HalfSineRun::impulse(101 * 1e-3));
  const auto bodies = cells_of("csv/bodies.csv");
  EXPECT_EQ(value(bodies, 102, "tool x [m]"), HalfSineRun::kSpeed * (101 * 1e-3));
  EXPECT_EQ(value(bodies, 102, "tool wy [rad/s]"), HalfSineRun::kTurnRate);
  const auto states = cells_of("csv/solver_state.csv");
  EXPECT_EQ(value(states, 102, "energy kinetic [J]"), 102.0);
  EXPECT_EQ(value(states, 102, "impulse gravity z [N s]"), HalfSineRun::kWeight * (101 * 1e-3));
  const auto commands = cells_of("csv/commands.csv");
  ASSERT_EQ(commands.size(), 2U);
  EXPECT_EQ(value(commands, 1, "vx [m/s]"), HalfSineRun::kSpeed);

  const auto index = cells_of("csv/particles.csv");
  ASSERT_EQ(index.size(), 1U + 3U);
  EXPECT_EQ(value(index, 1, "time [s]"), 0.0);
  EXPECT_EQ(value(index, 3, "time [s]"), 0.1);
  const auto particles = cells_of("csv/" + index[3][0]);
  ASSERT_EQ(particles.size(), 1U + 4U);
  EXPECT_EQ(value(particles, 4, "id [1]"), 9.0);
  EXPECT_EQ(static_cast<float>(value(particles, 4, "x [m]")), 0.03F);
  EXPECT_EQ(value(particles, 4, "vx [m/s]"), 100.0);
}

TEST_F(ReportTest, OutlineOfABodyIsAMeshWithSharedCorners) {
  ReportOptions options;
  options.bags = {bag_of({})};
  options.csv = in_folder("csv");
  std::ostringstream out;
  report(options, out, out, false);
  std::ifstream file(in_folder("csv/outline_tool.obj"));
  int corners = 0;
  std::vector<std::string> faces;
  for (std::string line; std::getline(file, line);) {
    corners += line.rfind("v ", 0) == 0;
    if (line.rfind("f ", 0) == 0) faces.push_back(line);
  }
  EXPECT_EQ(corners, 4);  // a tetrahedron; corners are numbered in order of appearance
  EXPECT_EQ(faces, (std::vector<std::string>{"f 1 2 3", "f 1 3 4", "f 1 4 2", "f 3 2 4"}));
}

TEST_F(ReportTest, SnapshotsAreSpreadAndThePeakIsAmongThem) {
  std::vector<std::int64_t> times;
  for (int i = 0; i <= 100; ++i) times.push_back(i);
  EXPECT_EQ(choose_snapshots(times, 3, std::nullopt), (std::set<std::size_t>{0, 50, 100}));
  EXPECT_EQ(choose_snapshots(times, 3, 7), (std::set<std::size_t>{0, 7, 100}));
  EXPECT_EQ(choose_snapshots(times, 4, 7), (std::set<std::size_t>{0, 7, 50, 100}));
  EXPECT_EQ(choose_snapshots(times, 4, 50), (std::set<std::size_t>{0, 50, 100}));
  EXPECT_EQ(choose_snapshots(times, 200, 7).size(), times.size());
  EXPECT_EQ(choose_snapshots(times, 1, std::nullopt), (std::set<std::size_t>{100}));
  EXPECT_EQ(choose_snapshots({5, 6}, 10, std::nullopt), (std::set<std::size_t>{0, 1}));
  EXPECT_TRUE(choose_snapshots({}, 10, std::nullopt).empty());
}

TEST_F(ReportTest, AFailedRunIsTold) {
  HalfSineRun run;
  run.on_state = [](int i, SolverState& message) {
    if (i == HalfSineRun::kIntervals) {
      message.failed = 1;
      message.failure = "particle 7 of soil is turned inside out";
    }
    return true;
  };
  ReportOptions options;
  options.bags = {bag_of(run)};
  std::ostringstream out;
  EXPECT_TRUE(report(options, out, out, false));
  EXPECT_TRUE(contains(out.str(), "the run failed at 0.101 s: particle 7 of soil is turned inside out")) << out.str();
}

TEST_F(ReportTest, FailedChecksAreTold) {
  HalfSineRun run;
  run.on_state = [](int i, SolverState&) { return i != 40; };
  ReportOptions options;
  options.bags = {bag_of(run)};
  std::ostringstream out;
  EXPECT_TRUE(report(options, out, out, false));  // not asked for
  options.check = true;
  EXPECT_FALSE(report(options, out, out, false));
  EXPECT_TRUE(contains(out.str(), "solver_state: 0.001 s missing before 0.041 s")) << out.str();
}

}  // namespace report_test
}  // namespace mpm_ros
