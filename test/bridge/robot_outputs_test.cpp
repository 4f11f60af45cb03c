// Outputs of a run's robots: a plate on two slides that is pressed into clay, against its target and the balance
// of forces; tables against the bag, and the messages of a run that goes on, stops or fails. Skipped in a build without
// robots. Cost: 5 s.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <mpm_ros/RobotStates.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/JointState.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <list>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mpm_robots/robots.hpp"
#include "mpm_ros/report/report.hpp"
#include "mpm_ros/report/temporary_folder.hpp"
#include "mpm_ros/run/run.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace robot_outputs_test {

using nlohmann::json;

constexpr double kGravity = 9.81;          // [m/s^2]
constexpr double kCarried = 4.0;           // [kg] by the slide `down`: column and plate
constexpr double kMoved = 9.0;             // [kg] by the slide `along`: cross, column and plate
constexpr double kPlate = 1.0;             // [kg]
constexpr double kBalanced = 1e-9;         // part of the largest force: round-off of sums over some ten steps
constexpr std::int64_t kSync = 2'000'000;  // [ns]

/// The columns of a CSV file without quotes.
std::map<std::string, std::vector<double>> table_of(const std::string& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  std::vector<std::string> names;
  std::map<std::string, std::vector<double>> columns;
  std::string line, cell;
  std::getline(file, line);
  for (std::stringstream header(line); std::getline(header, cell, ',');) names.push_back(cell);
  while (std::getline(file, line)) {
    std::size_t column = 0;
    for (std::stringstream row(line); std::getline(row, cell, ',');) {
      char* end = nullptr;
      const double value = std::strtod(cell.c_str(), &end);
      columns[names.at(column++)].push_back(end == cell.c_str() ? std::nan("") : value);
    }
  }
  return columns;
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

template <class Message>
std::vector<Message> messages_of(const std::string& path, const std::string& topic) {
  rosbag::Bag bag(path, rosbag::bagmode::Read);
  std::vector<Message> messages;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery("/mpm/" + topic)))
    messages.push_back(*instance.instantiate<Message>());
  return messages;
}

class RobotOutputsOfARun : public ::testing::Test {
 protected:
  void SetUp() override {
    mpm::provide_robots();
    try {
      write_scene("0", "0");
      const mpm::Scene scene = mpm::load_scene(scene_);
      const mpm::Simulation simulation(scene, {1});
    } catch (const mpm::Error& error) {
      if (std::string(error.what()).find("this build has no robots") == std::string::npos) throw;
      GTEST_SKIP() << "this build has no robots";
    }
  }

  /// A plate 10 mm above clay; targets of its slides.
  void write_scene(const std::string& along, const std::string& down) const {
    std::ofstream(scene_) << fmt::format(R"(name: gantry
gravity: [0, 0, -9.81]
grid: {{cell: 0.04, min: [-0.32, -0.2, -0.16], max: [0.32, 0.2, 0.4]}}
time: {{end: 0.1, cfl: 0.5, sync: 0.002}}
materials: [{{name: clay, law: j2_plasticity, density: 1800, young: 2 MPa, poisson: 0.4, yield_stress: 10 kPa}}]
bodies: [{{name: bed, material: clay, shape: {{box: {{min: [-0.32, -0.2, -0.16], max: [0.32, 0.2, 0]}}}}}}]
boundaries: {{all: slip, z_max: none}}
output: {{period: 1}}
robots:
  - name: gantry
    urdf: {}
    base: {{pose: {{position: [0, 0, 0.04]}}}}
    links: {{plate: {{friction: 0.3}}}}
    joints:
      along: {{drive: position, effort: 5000, target: "{}"}}
      down: {{drive: velocity, effort: 5000, target: "{}"}}
      turn: {{drive: position}}
    sensors: [turn]
)",
                                         data_file("robots/gantry.urdf"), along, down);
  }

  RunSceneOptions options_of(const std::string& name) const {
    RunSceneOptions options;
    options.scene = scene_;
    options.threads = 1;
    options.bag = folder_.file(name + ".bag");
    return options;
  }
  static void run(const RunSceneOptions& options) {
    std::ostringstream out, err;
    ASSERT_EQ(run_scene(options, out, err, false, [] { return false; }), RunSceneResult::done) << err.str();
  }
  /// A run that writes every fifth sync point.
  std::unique_ptr<mpm_ros::Run> begun(const std::string& bag, const std::string& resume = {}) {
    const mpm::Scene& scene = loaded_.emplace_back(mpm::load_scene(scene_));
    RunOptions options;
    options.threads = 1;
    options.output = output_options(scene);
    options.output.wrench_period = 5e-9 * kSync;
    options.bag = bag;
    options.resume = resume;
    auto run = std::make_unique<mpm_ros::Run>(scene, options, Stamps(), nullptr);
    run->begin();
    return run;
  }
  static void advance(mpm_ros::Run& run, int periods) {
    for (int k = 0; k < periods; ++k) run.advance();
  }

  TemporaryFolder folder_;
  std::list<mpm::Scene> loaded_;  // runs refer to theirs
  const std::string scene_ = folder_.file("gantry.yaml");
};

TEST_F(RobotOutputsOfARun, TablesFollowTheTargetAndBalance) {
  write_scene("0.01 * sin(20 * t)", "0.2");
  RunSceneOptions options = options_of("run");
  options.csv = folder_.file("csv");
  options.summary = folder_.file("summary.json");
  run(options);
  auto joints = table_of(folder_.file("csv/joints.csv")), robots = table_of(folder_.file("csv/robots.csv")),
       forces = table_of(folder_.file("csv/contact_forces.csv"));
  const std::size_t rows = joints["time [s]"].size();
  ASSERT_EQ(rows, 51U);
  const auto& pressed = forces["gantry/plate fz [N]"];
  const double largest = *std::max_element(pressed.begin(), pressed.end());
  ASSERT_GT(largest, 100.0);
  const auto stored = [&](std::size_t i) {
    return robots["gantry energy kinetic [J]"][i] + robots["gantry energy potential [J]"][i];
  };
  double spent = 0.0;
  for (std::size_t i = 1; i < rows; ++i) {
    const double time = joints["time [s]"][i];
    // A rigid drive is where its target is at the end of a step.
    EXPECT_NEAR(joints["gantry/along position [m]"][i], 0.01 * std::sin(20.0 * time), 1e-12);
    EXPECT_NEAR(joints["gantry/along target [m]"][i], 0.01 * std::sin(20.0 * time), 1e-12);
    EXPECT_NEAR(joints["gantry/down position [m]"][i], 0.2 * time, 1e-12);
    // Force is mass times what the velocity gained in the interval, over its length.
    const double gained = joints["gantry/along velocity [m/s]"][i] - joints["gantry/along velocity [m/s]"][i - 1];
    EXPECT_NEAR(joints["gantry/along effort [N]"][i], kMoved * gained / 0.002 - forces["gantry/plate fx [N]"][i],
                kBalanced * largest);
    if (i == 1) continue;  // the slide gets its speed, over half of the way that it takes in that step
    EXPECT_NEAR(joints["gantry/down effort [N]"][i], pressed[i] - kCarried * kGravity, kBalanced * largest);
    EXPECT_NEAR(joints["gantry/turn fz [N]"][i], kPlate * kGravity - pressed[i], kBalanced * largest);
    double given = 0.0;
    for (const char* work : {"drive", "damping", "friction", "limit", "contact"}) {
      const auto& column = robots[fmt::format("gantry energy {} [J]", work)];
      given += column[i] - column[1];
    }
    spent = std::max(spent, std::abs(robots["gantry energy drive [J]"][i]));
    EXPECT_NEAR(stored(i) - stored(1), given, 1e-9 * spent) << time;
  }
  const json summary = json::parse(bytes_of(folder_.file("summary.json"))).at("robots").at("gantry");
  EXPECT_EQ(summary.at("joints").at("down").at("position"), joints["gantry/down position [m]"].back());
  EXPECT_EQ(summary.at("joints").at("down").at("unit"), "m");
  EXPECT_EQ(summary.at("energy").at("drive"), robots["gantry energy drive [J]"].back());

  ReportOptions report;
  report.bags = {options.bag};
  report.csv = folder_.file("again");
  report.json = "-";
  report.check = true;
  std::ostringstream out, err;
  ASSERT_EQ(run_report(report, out, err, false), ReportResult::done) << out.str() << err.str();
  for (const char* table : {"joints.csv", "robots.csv"})
    EXPECT_EQ(bytes_of(folder_.file(std::string("csv/") + table)),
              bytes_of(folder_.file(std::string("again/") + table)));
  const json down = json::parse(out.str()).at("robots").at("gantry").at("joints").at("down");
  EXPECT_EQ(down.at("effort").at("end"), joints["gantry/down effort [N]"].back());
  EXPECT_EQ(messages_of<sensor_msgs::JointState>(options.bag, "robots/gantry/joint_states").back().effort[1],
            joints["gantry/down effort [N]"].back());
}

// At rest the drive holds the weight, downwards is positive.
TEST_F(RobotOutputsOfARun, ARunThatGoesOnBeginsWithItsRobots) {
  RunSceneOptions options = options_of("first");
  options.end = "10 ms";
  options.checkpoint = folder_.file("at_10_ms.h5");
  run(options);
  options = options_of("second");
  options.end = "20 ms";
  options.resume = folder_.file("at_10_ms.h5");
  run(options);
  const auto states = messages_of<sensor_msgs::JointState>(options.bag, "robots/gantry/joint_states");
  ASSERT_EQ(states.size(), 6U);
  EXPECT_EQ(states[0].header.stamp.toNSec(), 5U * kSync);
  for (const sensor_msgs::JointState& state : states)
    EXPECT_NEAR(state.effort[1], -kCarried * kGravity, 1e-9 * kCarried * kGravity);
}

// The slide gets its speed within the interval in whose middle the run is saved.
TEST_F(RobotOutputsOfARun, MeansThatAreUnderWayGoOnFromACheckpoint) {
  write_scene("0.01 * sin(20 * t)", "0.2");
  const std::string checkpoint = folder_.file("middle.h5");
  const std::unique_ptr<mpm_ros::Run> whole = begun(folder_.file("whole.bag"));
  advance(*whole, 3);
  whole->save(checkpoint);
  advance(*whole, 2);
  whole->finish();
  const std::unique_ptr<mpm_ros::Run> rest = begun(folder_.file("rest.bag"), checkpoint);
  advance(*rest, 2);
  rest->finish();
  const auto all = messages_of<RobotStates>(folder_.file("whole.bag"), "robots"),
             again = messages_of<RobotStates>(folder_.file("rest.bag"), "robots");
  ASSERT_EQ(all.size(), 2U);  // at the start and after five sync points
  ASSERT_EQ(again.size(), 2U);
  EXPECT_EQ(again[0].header.stamp.toNSec(), 3U * kSync);
  // Held at its speed, the slide carries the weight alone; the mean has the push of the start in it.
  EXPECT_NEAR(again[0].robots[0].effort[1], -kCarried * kGravity, 1e-9 * kCarried * kGravity);
  EXPECT_NEAR(again[1].robots[0].effort[1], kCarried * (0.2 / (5e-9 * kSync) - kGravity), 1e-9 * kCarried * kGravity);
  EXPECT_EQ(again[1], all[1]);
}

TEST_F(RobotOutputsOfARun, ARunThatStopsOrFailsBetweenTwoMessagesEndsWithItsRobots) {
  for (const bool fails : {false, true}) {
    const std::string bag = folder_.file(fails ? "failed.bag" : "stopped.bag");
    const std::unique_ptr<mpm_ros::Run> run = begun(bag);
    advance(*run, 3);
    fails ? run->fail("it was made to") : run->finish();
    const auto states = messages_of<RobotStates>(bag, "robots");
    ASSERT_EQ(states.size(), 2U);
    EXPECT_EQ(states[1].header.stamp.toNSec(), 3U * kSync);
    EXPECT_NEAR(states[1].robots[0].effort[1], -kCarried * kGravity, 1e-9 * kCarried * kGravity);
    EXPECT_NEAR(states[1].robots[0].sensors.at(0).wrench.force.z, kPlate * kGravity, 1e-9 * kPlate * kGravity);
    EXPECT_EQ(messages_of<geometry_msgs::WrenchStamped>(bag, "robots/gantry/sensors/turn/wrench").size(), 2U);
  }
}

}  // namespace robot_outputs_test
}  // namespace mpm_ros
