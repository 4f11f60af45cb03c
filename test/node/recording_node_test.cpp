// Recordings of the node: killed, on a full disk, split, with a name of their own, and run again.
#include <mpm_ros/BodyStates.h>
#include <std_srvs/Trigger.h>

#include <sstream>

#include "mpm_ros/message/bag_parts.hpp"
#include "mpm_ros/report/report_bag.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "simulator_process.hpp"
#include "test_files.hpp"

namespace mpm_ros::test {
namespace recording_node_test {

const std::string kPress = "scene:=" + data_file("press.yaml");
constexpr std::int64_t kSync = 2'000'000;  // [ns]

/// Times of the body states in a recording, which must have no gap from the start on.
std::vector<std::int64_t> times_in(const std::string& bag) {
  struct Times : RunVisitor {
    void bodies(std::int64_t time, const BodyStates&) override { times.push_back(time); }
    std::vector<std::int64_t> times;
  } visitor;
  RunBag(bag, "").read({&visitor});
  for (std::size_t i = 0; i < visitor.times.size(); ++i) {
    EXPECT_EQ(visitor.times[i], kSync * static_cast<std::int64_t>(i));
  }
  return visitor.times;
}

TEST(Recording, AKilledNodeLosesItsLastChunkAtMost) {
  const TemporaryFolder folder;
  const std::string bag = folder.file("run.bag");
  SimulatorProcess simulator(
      {kPress, "pacing:=lockstep", "threads:=1", "set:=[time.end=100, time.sync=0.002]", "record:=" + bag});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  ASSERT_TRUE(simulator.step(200).success);
  // A chunk ends at the first sync point after a second. Then sync point 201 and all before it are on the disk.
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  ASSERT_TRUE(simulator.step(1).success);
  ASSERT_TRUE(simulator.step(20).success);
  simulator.signal(SIGKILL);
  EXPECT_EQ(simulator.wait(), -2);
  EXPECT_THROW(rosbag::Bag{bag}, rosbag::BagException);  // no index
  const std::size_t recorded = times_in(bag).size();     // with the state at the start
  EXPECT_GE(recorded, 202U);
  EXPECT_LE(recorded, 222U);
}

TEST(Recording, ANodeKilledAtItsStartLeavesItsScene) {
  const TemporaryFolder folder;
  const std::string bag = folder.file("run.bag");
  SimulatorProcess simulator({kPress, "start_paused:=true", "threads:=1", "record:=" + bag});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<SolverState> state(simulator.name("solver_state"));  // latched: published once the start is recorded
  ASSERT_TRUE(state.hears(1)) << simulator.log();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  simulator.signal(SIGKILL);
  EXPECT_EQ(simulator.wait(), -2);
  EXPECT_EQ(times_in(bag).size(), 1U);
  EXPECT_NE(RunBag(bag, "").info()->scene_text.find("plate"), std::string::npos);
}

/// A cloud at each of 501 sync points: about 3 MB.
const std::string kLarge = "set:=[time.end=1, time.sync=0.002, output.period=0.002]";

TEST(Recording, AFullDiskEndsTheRunWithOneLine) {
  const TemporaryFolder folder;
  const std::string bag = folder.file("run.bag");
  SimulatorProcess simulator({kPress, "pacing:=free", "threads:=1", kLarge, "record:=" + bag}, 2'000'000);
  EXPECT_EQ(simulator.wait(), 1) << simulator.log();
  const std::vector<std::string> lines = simulator.fatal_lines();
  ASSERT_EQ(lines.size(), 1U) << simulator.log();
  EXPECT_NE(lines[0].find(bag), std::string::npos) << lines[0];
  EXPECT_NE(lines[0].find("File too large"), std::string::npos) << lines[0];
  EXPECT_GE(times_in(bag).size(), 2U);
}

TEST(Recording, ARecordThatIsNotRequiredMayEnd) {
  const TemporaryFolder folder;
  const std::string bag = folder.file("run.bag");
  SimulatorProcess simulator(
      {kPress, "pacing:=lockstep", "threads:=1", kLarge, "record:=" + bag, "record_required:=false"}, 1'000'000);
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  ASSERT_TRUE(diagnostics.connected());
  const Step::Response response = simulator.step(400);
  EXPECT_TRUE(response.success) << response.message;
  EXPECT_NEAR(response.time, 0.8, 1e-12);
  EXPECT_TRUE(diagnosed(diagnostics, simulator, "not recorded any more: bag " + bag));
  EXPECT_NE(simulator.log().find("goes on without a record"), std::string::npos) << simulator.log();
  simulator.signal(SIGINT);
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  EXPECT_GE(times_in(bag).size(), 2U);
}

TEST(Recording, SplitBagsOfEachRunReplayToTheSameState) {
  const TemporaryFolder folder;
  const std::string bag = folder.file("run.bag"), second = folder.file("run_2.bag");
  {
    SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1", "set:=[time.sync=0.002]",
                                "record_folder:=" + folder.path(), "record:=run.bag", "record_split_duration:=0.05"});
    ASSERT_TRUE(simulator.ready()) << simulator.log();
    ASSERT_TRUE(simulator.step(30, {velocity("plate", -0.1)}).success);
    std_srvs::Trigger reset;
    ASSERT_TRUE(simulator.call("reset", reset));
    ASSERT_TRUE(simulator.step(30, {velocity("plate", -0.1)}).success);
    ASSERT_TRUE(simulator.step(70, {velocity("plate", -0.05)}).success);
    simulator.signal(SIGINT);
    EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  }
  EXPECT_EQ(parts_of(bag).size(), 2U);     // to 0.06 s
  EXPECT_EQ(parts_of(second).size(), 4U);  // to 0.2 s
  EXPECT_EQ(times_in(bag).size(), 31U);
  EXPECT_EQ(times_in(second).size(), 101U);
  const std::string hash = hash_in(part_path(second, 4));
  EXPECT_EQ(hash.size(), 16U);

  const std::string replayed = folder.file("replayed.bag");
  SimulatorProcess replay(
      {kPress, "pacing:=free", "threads:=2", "set:=[time.sync=0.002]", "commands:=" + second, "record:=" + replayed});
  EXPECT_EQ(replay.wait(), 0) << replay.log();
  EXPECT_EQ(hash_in(replayed), hash);

  for (const std::string& recording : {bag, second}) {
    RunSceneOptions options;
    options.from_bag = recording;
    options.threads = 1;
    std::ostringstream out, err;
    EXPECT_EQ(run_scene(options, out, err, false, [] { return false; }), RunSceneResult::done) << err.str();
    EXPECT_NE(out.str().find("equal to the recorded one"), std::string::npos) << out.str();
  }
}

TEST(Recording, AutoNamesABagThatIsNotThere) {
  const TemporaryFolder folder;
  for (int run = 0; run < 2; ++run) {
    SimulatorProcess simulator(
        {kPress, "pacing:=free", "threads:=1", "record:=auto", "record_folder:=" + folder.path()});
    EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  }
  int bags = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    ++bags;
    EXPECT_EQ(entry.path().filename().string().compare(0, 10, "mpm_press_"), 0) << entry.path();
  }
  EXPECT_EQ(bags, 2);
}

}  // namespace recording_node_test
}  // namespace mpm_ros::test
