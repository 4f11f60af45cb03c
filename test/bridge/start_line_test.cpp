// The node's first line, and the pace that a run is expected to have.
#include "mpm_ros/node/start_line.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>

#include "mpm_ros/run/expected_pace.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace start_line_test {

namespace fs = std::filesystem;

StartFacts blade() {
  StartFacts facts;
  facts.scene = "blade_in_soil";
  facts.particles = 40640;
  facts.threads = 2;
  facts.name_space = "/mpm";
  facts.end = 1.5;
  return facts;
}

TEST(StartLine, SaysWhatRunsAndWhatItWaitsFor) {
  StartFacts facts = blade();
  EXPECT_EQ(start_line(facts), "blade_in_soil: 40640 particles, real time, 2 threads, in /mpm; runs to 1.5 s");
  facts.heights = {{"soil", "/hills"}};
  EXPECT_EQ(
      start_line(facts),
      "blade_in_soil: 40640 particles, real time, 2 threads, in /mpm; has the heights of 'soil' from /hills; runs to "
      "1.5 s");
  facts.heights.clear();
  facts.pacing = Pacing::lockstep;
  EXPECT_EQ(start_line(facts),
            "blade_in_soil: 40640 particles, lockstep, 2 threads, in /mpm; waits for the service /mpm/step");
  facts.paused = true;
  EXPECT_EQ(
      start_line(facts),
      "blade_in_soil: 40640 particles, lockstep, 2 threads, in /mpm; waits for the service /mpm/pause with false; "
      "then for the service /mpm/step");
  facts.pacing = Pacing::free;
  facts.threads = 1;
  facts.name_space = "/";
  EXPECT_EQ(start_line(facts),
            "blade_in_soil: 40640 particles, as fast as it goes, 1 thread, in /; waits for the service /pause with "
            "false");
}

TEST(StartLine, NamesFramesClockAndRecordedCommands) {
  StartFacts facts = blade();
  facts.real_time_factor = 0.5;
  facts.end = 0.0;
  facts.clock = true;
  facts.frames = {{"hand", "tool0"}};
  EXPECT_EQ(start_line(facts),
            "blade_in_soil: 40640 particles, 0.5 of real time, 2 threads, in /mpm; runs until it is stopped; 'hand' "
            "waits for the tf frame 'tool0'; publishes /clock");
  facts.commands = "run.bag";  // commands move it in place of the frame
  EXPECT_EQ(start_line(facts),
            "blade_in_soil: 40640 particles, 0.5 of real time, 2 threads, in /mpm; runs until it is stopped; commands "
            "come from run.bag; publishes /clock");
}

/// With a cache of its own.
class ExpectedPaceTest : public ::testing::Test {
 protected:
  ExpectedPaceTest() : folder_(fs::temp_directory_path() / ("mpm_expected_pace_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    if (const char* before = getenv("XDG_CACHE_HOME")) before_ = before;
    setenv("XDG_CACHE_HOME", folder_.c_str(), 1);
    options_.threads = 1;
  }
  ~ExpectedPaceTest() override {
    before_.empty() ? unsetenv("XDG_CACHE_HOME") : setenv("XDG_CACHE_HOME", before_.c_str(), 1);
    fs::remove_all(folder_);
  }
  fs::path folder_;
  std::string before_;
  RunOptions options_;
};

TEST_F(ExpectedPaceTest, IsTimedOnceAndKept) {
  const mpm::Scene scene = mpm::load_scene("falling_block");
  EXPECT_FALSE(expected_pace(scene, options_, 1.0, false)) << "nothing is known yet";
  const auto timed = expected_pace(scene, options_, 1.0, true);
  ASSERT_TRUE(timed);
  EXPECT_EQ(timed->forecast.particles, 100U);
  EXPECT_EQ(timed->forecast.threads, 1);
  EXPECT_EQ(timed->forecast.simulated, 0.4);
  const auto kept = expected_pace(scene, options_, 1.0, false);
  ASSERT_TRUE(kept);
  EXPECT_NEAR(kept->forecast.cost.step_seconds / timed->forecast.cost.step_seconds, 1.0, 1e-5);  // as it is written
  EXPECT_NE(expected_text(*kept).find(" timed"), std::string::npos);
  EXPECT_FALSE(expected_pace(mpm::load_scene("falling_block", {"grid.cell=0.05"}), options_, 1.0, false));
  // No machine is a million times as fast as real time.
  const auto wanted = expected_pace(scene, options_, 1e9, false);
  ASSERT_TRUE(wanted);
  EXPECT_EQ(pace_warning(*wanted).find("a pace of 1e+09 of real time is not in reach: "), 0U) << pace_warning(*wanted);
  EXPECT_NE(pace_warning(*wanted).find("grid.cell="), std::string::npos);
  EXPECT_EQ(pace_warning(*expected_pace(scene, options_, 1e-9, false)), "");
}

TEST_F(ExpectedPaceTest, IsThatOfARunThatEnded) {
  const mpm::Scene scene = mpm::load_scene("falling_block");
  const auto run = [&](double end) {
    mpm::Simulation simulation(mpm::build(scene), {1});
    while (1e-9 * static_cast<double>(simulation.time()) < end) simulation.advance();
    keep_reached_pace(scene, 1, simulation);
    return simulation.state();
  };
  const mpm::SolverState whole = run(0.4);
  run(0.1);  // has fewer steps, and does not replace it
  std::ostringstream out;
  RunSceneOptions explained;
  explained.threads = 1;
  explained.scene = "falling_block";
  explain_scene(explained, out);
  const auto expected = expected_pace(scene, options_, 1.0, false);
  ASSERT_TRUE(expected);
  const mpm::pace::StepCost& cost = expected->forecast.cost;
  // The explanation, which leaves out the first step, cannot have timed more.
  EXPECT_NE(out.str().find(fmt::format("; {} steps timed", whole.step.steps)), std::string::npos) << out.str();
  EXPECT_EQ(cost.steps, whole.step.steps);
  EXPECT_NEAR(cost.step_seconds * static_cast<double>(whole.step.steps) / whole.wall_seconds, 1.0, 1e-5);
  EXPECT_NEAR(cost.steps_per_second * 0.4 / static_cast<double>(whole.step.steps), 1.0, 1e-5);
}

TEST_F(ExpectedPaceTest, IsExplainedWithWhatWouldHelp) {
  RunSceneOptions options;
  options.threads = 1;
  options.scene = "falling_block";
  options.set = {"time.step=1e-8", "time.end=0.001"};  // no machine does 1e8 steps a second
  // USF helps, with one strain pass in place of two, on any machine; single precision does not in so small a scene.
  // Time that another process takes may hide it, so the scene is timed again then.
  std::ostringstream out;
  for (int attempt = 0; attempt < 10 && out.str().find("method.update=usf") == std::string::npos; ++attempt) {
    out.str("");
    fs::remove_all(folder_ / "mpm_ros");
    explain_scene(options, out);
  }
  for (const char* text :
       {"\npace: ", " of real time expected on 1 thread; 0.001 s will take ", "(100000 steps of ", "kept for a day in ",
        "real time is not in reach", "method.update=usf", "timed on this scene", "would reach "}) {
    EXPECT_NE(out.str().find(text), std::string::npos) << text << "\n" << out.str();
  }
  EXPECT_TRUE(fs::is_regular_file(folder_ / "mpm_ros" / "step_costs.csv"));
}

}  // namespace start_line_test
}  // namespace mpm_ros
