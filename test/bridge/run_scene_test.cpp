// The program run_scene with its options: results, exit codes, and the files that it writes however a run ends.
#include "mpm_ros/run/run_scene.hpp"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mpm_ros/message/progress_bar.hpp"
#include "mpm_ros/report/report.hpp"
#include "mpm_ros/run/run_scene_options.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace run_scene_test {

namespace fs = std::filesystem;

class RunScene : public ::testing::Test {
 protected:
  RunScene() : folder_(fs::temp_directory_path() / ("mpm_run_scene_test_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    options_.scene = source_file("config/scenes/falling_block.yaml");
    options_.threads = 1;
    options_.end = "50 ms";
    options_.summary = (folder_ / "summary.json").string();
  }
  ~RunScene() override { fs::remove_all(folder_); }

  RunSceneResult run(const std::function<bool()>& stop = [] { return false; }) {
    out_.str("");
    err_.str("");
    return run_scene(options_, out_, err_, false, stop);
  }
  nlohmann::json summary() const {
    std::ifstream file(options_.summary);
    return nlohmann::json::parse(file);
  }

  fs::path folder_;
  RunSceneOptions options_;
  std::ostringstream out_, err_;
};

TEST_F(RunScene, WritesASummaryWithItsKeysAndTheRightNumbers) {
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  const nlohmann::json root = summary();
  for (const char* key :
       {"scene", "method", "particles", "steps", "time", "dt", "wall_seconds", "particle_steps_per_second",
        "real_time_factor", "peak_memory_bytes", "threads", "state_hash", "energy", "momentum_error", "contact_impulse",
        "friction_energy", "contact_pairs", "returned", "metrics"}) {
    EXPECT_TRUE(root.contains(key)) << key;
  }
  for (const char* key : {"geometry", "shape", "update", "transfer", "precision", "isa"}) {
    EXPECT_TRUE(root["method"].contains(key)) << key;
  }
  EXPECT_EQ(root["method"]["precision"], "double");
  for (const char* key : {"min", "max", "limited_by"}) EXPECT_TRUE(root["dt"].contains(key)) << key;
  EXPECT_EQ(root["scene"], "falling_block");
  EXPECT_EQ(root["particles"], 100);
  EXPECT_EQ(root["time"], 0.05);
  // Free fall: v = -g t, kinetic energy m v^2 / 2 of 10 kg; round-off of some hundred steps.
  EXPECT_NEAR(root["metrics"]["mean_vz"].get<double>(), -9.81 * 0.05, 1e-12);
  EXPECT_NEAR(root["energy"]["end"]["kinetic"].get<double>(), 5.0 * std::pow(9.81 * 0.05, 2), 1e-11);
  // The block's middle at 0.25 m: m g z = 24.525 J.
  EXPECT_NEAR(root["energy"]["start"]["potential"].get<double>(), 24.525, 1e-11);
  EXPECT_LT(root["momentum_error"].get<double>(), 1e-10);
  EXPECT_EQ(root["state_hash"].get<std::string>().size(), 16U);
}

TEST_F(RunScene, SaysWhereThreadsAreMoreThanTheMachineHas) {
  EXPECT_EQ(thread_warning(0), "");
  EXPECT_EQ(thread_warning(1), "");
  EXPECT_EQ(thread_warning(1 << 20).find("1048576 threads on "), 0U) << thread_warning(1 << 20);
}

TEST_F(RunScene, SaysOnWhatItRunsAndRan) {
  options_.isa = "plain";
  options_.set = {"method.precision=single"};
  std::ostringstream explained;
  explain_scene(options_, explained);
  EXPECT_NE(explained.str().find("\nkernels: instruction set plain, 1 thread\n"), std::string::npos) << explained.str();
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_NE(out_.str().find("on 1 thread (plain, single precision)"), std::string::npos) << out_.str();
}

TEST_F(RunScene, AShorterRunIsTheBeginningOfALongerOne) {
  ASSERT_EQ(run(), RunSceneResult::done);
  const std::string whole = summary()["state_hash"];
  // Stopped after twenty sync periods of 2.5 ms, at the end of the run before.
  options_.end.clear();
  int asked = 0;
  ASSERT_EQ(run([&asked] { return asked++ == 20; }), RunSceneResult::done);
  EXPECT_EQ(summary()["time"], 0.05);
  EXPECT_EQ(summary()["state_hash"], whole);
  EXPECT_NE(err_.str().find("stopped at t = 0.05 s"), std::string::npos) << err_.str();
}

TEST_F(RunScene, WritesTablesAndABagThatOpens) {
  options_.csv = (folder_ / "tables").string();
  options_.bag = (folder_ / "run.bag").string();
  options_.scene = source_file("config/scenes/compressed_block.yaml");
  options_.end = "0.01";
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  for (const char* name : {"contact_forces.csv", "bodies.csv", "solver_state.csv", "particles_0000.csv"}) {
    EXPECT_TRUE(fs::is_regular_file(fs::path(options_.csv) / name)) << name;
  }
  std::ifstream table(fs::path(options_.csv) / "contact_forces.csv");
  std::string header;
  std::getline(table, header);
  EXPECT_EQ(header.find("time [s],anvil fx [N]"), 0U) << header;
  rosbag::Bag bag(options_.bag, rosbag::bagmode::Read);
  EXPECT_GT(rosbag::View(bag).size(), 0U);
}

TEST_F(RunScene, TellsWhatDeformableBodiesDidToEachOther) {
  options_.scene = (folder_ / "collision.yaml").string();
  std::ofstream(options_.scene) << R"(geometry: plane_strain
grid: {cell: 0.05, min: [0, 0], max: [1, 0.6]}
time: {end: 0.12}
materials:
  - {name: rubber, density: 1000, law: neo_hookean, young: 1 MPa, poisson: 0.3}
bodies:
  - {name: left, material: rubber, shape: {box: {min: [0.2, 0.2], max: [0.4, 0.4]}}, initial: {velocity: [1, 0]}}
  - {name: right, material: rubber, shape: {box: {min: [0.5, 0.3], max: [0.7, 0.5]}}, initial: {velocity: [-0.5, 0]}}
contact: {pairs: [{between: [left, right], friction: 0.3}]}
output: {particle_fields: [vx, vy, vz]}
metrics:
  vx: {mean: vx, of: right}
  vz: {mean: vz, of: right}
)";
  options_.end.clear();
  options_.bag = (folder_ / "run.bag").string();
  options_.csv = (folder_ / "tables").string();
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  const nlohmann::json root = summary();
  const nlohmann::json& pair = root["contact_pairs"]["left/right"];
  // Without an external force the impulse on the right block is the change of its momentum; its mass is 40 kg (0.2 m x
  // 0.2 m x 1 m). Round-off of some hundred steps, each of which exchanges at most 40 N s.
  const double mass = 40.0, round_off = 1e-10 * mass;
  EXPECT_NEAR(pair["impulse"][0].get<double>(), mass * (root["metrics"]["vx"].get<double>() + 0.5), round_off);
  EXPECT_NEAR(pair["impulse"][2].get<double>(), mass * root["metrics"]["vz"].get<double>(), round_off);
  EXPECT_GT(pair["impulse"][0].get<double>(), 20.0);  // 20 N s would stop it; it rebounds
  EXPECT_GE(pair["friction_energy"].get<double>(), 0.0);
  EXPECT_EQ(pair["friction_energy"], root["energy"]["end"]["pair_friction"]);
  EXPECT_NE(out_.str().find("contact of left/right: impulse on the second "), std::string::npos) << out_.str();
  EXPECT_TRUE(fs::is_regular_file(fs::path(options_.csv) / "contact_pairs.csv"));

  // The bag has the same values, message by message.
  ReportOptions report;
  report.bags = {options_.bag};
  report.check = true;
  std::ostringstream out, err;
  EXPECT_EQ(run_report(report, out, err, false), ReportResult::done) << out.str() << err.str();
  EXPECT_NE(out.str().find("Contact of deformable bodies"), std::string::npos) << out.str();
}

// The wheel's speed is a rate over a window that has not come.
TEST_F(RunScene, TellsThatAMetricHasNoValueYet) {
  options_.scene = source_file("config/scenes/wheel_in_sand.yaml");
  options_.end = "10 ms";
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_NE(out_.str().find("speed has no value: its window held less than two sync points"), std::string::npos)
      << out_.str();
  EXPECT_EQ(out_.str().find("nan"), std::string::npos) << out_.str();
  EXPECT_TRUE(summary()["metrics"]["speed"].is_null());
}

// The rod is at x = 0.17 m in a grid to 0.2 m and moves at 1 m/s. The circle around the box of its radius of 15 mm has
// one of 21.2 mm: it is beside the grid after 0.0512 s, and told of at the next sync point, of 2 ms.
TEST_F(RunScene, TellsOfABodyThatLeavesTheGrid) {
  options_.scene = source_file("test/data/press.yaml");
  options_.set = {"rigid_bodies.rod.motion={velocity: [1, 0]}"};
  options_.end = "0.1";
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  const std::string told = "warning: rigid body 'rod' has left the grid at t = 0.052 s";
  EXPECT_NE(err_.str().find(told), std::string::npos) << err_.str();
  EXPECT_EQ(err_.str().find(told), err_.str().rfind("warning: rigid body 'rod' has left")) << err_.str();
}

TEST_F(RunScene, CountsParticlesThatWerePutBack) {
  // The block falls out of the grid. Its lowest row of ten particles, at 0.205 m, leaves after 0.2044 s; the next, 0.01
  // m above, after 0.2094 s: sqrt(2 h / g).
  options_.set = {"boundaries={}", "grid.leave={limit: 10}"};
  options_.end = "207.5 ms";
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  EXPECT_EQ(summary()["returned"], 10);
  EXPECT_NE(out_.str().find("particles that left the grid and were put back: 10"), std::string::npos) << out_.str();
}

TEST_F(RunScene, PhysicsThatFailEndWithThreeAndLeaveEverythingWritten) {
  // The block falls out of the grid after 0.2 s.
  options_.set = {"boundaries={}"};
  options_.end.clear();
  options_.bag = (folder_ / "run.bag").string();
  EXPECT_EQ(run(), RunSceneResult::physics_failed);
  for (const char* part : {"particle ", "step ", "grid.min"}) {
    EXPECT_NE(err_.str().find(part), std::string::npos) << part << " not in: " << err_.str();
  }
  // sqrt(2 h / g) for the lowest particles, half a spacing above the block's face at 0.2 m.
  EXPECT_NEAR(summary()["time"].get<double>(), std::sqrt(2.0 * 0.205 / 9.81), 0.0025);  // a sync period
  rosbag::Bag bag(options_.bag, rosbag::bagmode::Read);
  EXPECT_GT(rosbag::View(bag).size(), 0U);
}

TEST_F(RunScene, AFailureBesideAToolNamesItAndItsTablesAreWritten) {
  // The rod pushes a strip of three cells out of the grid at x = 0.2 m.
  options_.scene = data_file("press.yaml");
  options_.set = {"bodies.strip.shape={box: {min: [0.16, 0], max: [0.19, 0.04]}}",
                  "rigid_bodies.rod.pose={position: [0.14, 0.02]}", "rigid_bodies.rod.motion={velocity: [2, 0]}"};
  options_.end = "0.1 s";
  options_.csv = (folder_ / "csv").string();
  EXPECT_EQ(run(), RunSceneResult::physics_failed) << err_.str();
  EXPECT_NE(err_.str().find("cells from rigid body 'rod'"), std::string::npos) << err_.str();
  EXPECT_EQ(err_.str().find("columns"), std::string::npos) << err_.str();
  std::ifstream table(fs::path(options_.csv) / "contact_forces.csv");
  std::string header, row;
  std::getline(table, header);
  while (std::getline(table, row)) {
    EXPECT_EQ(std::count(row.begin(), row.end(), ','), std::count(header.begin(), header.end(), ','));
  }
}

TEST_F(RunScene, BadInputEndsWithTwoAndOneLine) {
  const auto refused = [this](const std::string& part) {
    EXPECT_EQ(run(), RunSceneResult::bad_input) << part;
    EXPECT_NE(err_.str().find(part), std::string::npos) << err_.str();
    EXPECT_EQ(err_.str().find('\n'), err_.str().size() - 1) << err_.str();
  };
  const RunSceneOptions good = options_;
  options_.end = "5 m";
  refused("--end: '5 m' is a length, but a time is expected");
  options_ = good;
  options_.set = {"grid.cel=1"};
  refused("--set grid.cel=1: grid.cel: unknown key 'cel'; did you mean 'cell'?");
  options_ = good;
  options_.scene = "fallin_block";
  refused("did you mean 'falling_block'?");
  options_ = good;
  options_.summary = (folder_ / "no/such/folder.json").string();
  refused("cannot be written");
  options_ = good;
  std::ofstream(options_.summary) << "of an earlier run";
  options_.isa = "sse9";
  refused("--isa: there is no instruction set 'sse9'; this machine has plain");
  std::ostringstream kept;
  kept << std::ifstream(options_.summary).rdbuf();
  EXPECT_EQ(kept.str(), "of an earlier run");
  options_ = good;
  options_.bag = (folder_ / "no/such.bag").string();
  refused("no/such.bag");
  options_ = good;
  options_.end.clear();
  options_.set = {"time={}"};
  refused("the scene has no end");
}

TEST(ClockText, CountsHoursAndMinutes) {
  EXPECT_EQ(clock_text(7.2), "0:07");
  EXPECT_EQ(clock_text(754.0), "12:34");
  EXPECT_EQ(clock_text(10921.0), "3:02:01");
}

TEST(ProgressBar, WritesALineForEachTenthWhereThereIsNoTerminal) {
  std::ostringstream out;
  ProgressBar bar(out, false, std::chrono::milliseconds(0));
  for (int i = 0; i <= 1000; ++i) bar.show(0.001 * i, [] { return "half way"; });
  bar.clear();
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 9);  // 10 to 90 %
  EXPECT_EQ(text.find(" 10 %  half way  0:00 left\n"), 0U) << text;
  EXPECT_EQ(text.find('\r'), std::string::npos);
  std::ostringstream brief;
  ProgressBar(brief, false).show(0.5, [] { return "half way"; });  // at once: a short work says nothing
  EXPECT_EQ(brief.str(), "");
}

}  // namespace run_scene_test
}  // namespace mpm_ros
