// Checkpoints of run_scene and of a run: a resumed run ends like one that was never stopped.
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mpm_ros/command/command_limiter.hpp"
#include "mpm_ros/command/command_queue.hpp"
#include "mpm_ros/command/command_watch.hpp"
#include "mpm_ros/command/joint_queue.hpp"
#include "mpm_ros/command/turning_twists.hpp"
#include "mpm_ros/report/temporary_folder.hpp"
#include "mpm_ros/run/run.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace run_checkpoint_test {

namespace fs = std::filesystem;

class RunCheckpoint : public ::testing::Test {
 protected:
  RunCheckpoint() {
    options_.scene = source_file("config/scenes/falling_block.yaml");
    options_.threads = 1;
    options_.end = "50 ms";  // twenty sync periods of 2.5 ms
    options_.summary = folder_.file("summary.json");
  }
  RunSceneResult run(const std::function<bool()>& stop = [] { return false; }) {
    out_.str("");
    err_.str("");
    return run_scene(options_, out_, err_, false, stop);
  }
  nlohmann::json summary() const {
    std::ifstream file(options_.summary);
    return nlohmann::json::parse(file);
  }
  void expect_bad_input(const std::string& text) {
    EXPECT_EQ(run(), RunSceneResult::bad_input);
    EXPECT_NE(err_.str().find(text), std::string::npos) << err_.str();
    const std::string all = err_.str();
    EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 1) << all;
  }

  const TemporaryFolder folder_;
  RunSceneOptions options_;
  std::ostringstream out_, err_;
};

TEST_F(RunCheckpoint, StoppedAndResumedEndsAsUninterrupted) {
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  const nlohmann::json whole = summary();
  // Stopped after seven periods, as by SIGINT.
  options_.checkpoint = folder_.file("run.h5");
  int asked = 0;
  ASSERT_EQ(run([&asked] { return asked++ == 7; }), RunSceneResult::done) << err_.str();
  EXPECT_EQ(summary()["time"], 0.0175);
  EXPECT_NE(out_.str().find("checkpoint " + options_.checkpoint + " at t = 0.0175 s"), std::string::npos) << out_.str();
  // The file alone is enough to continue.
  options_.resume = options_.checkpoint;
  options_.checkpoint.clear();
  options_.scene.clear();
  options_.bag = folder_.file("rest.bag");
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  const nlohmann::json resumed = summary();
  for (const char* key : {"state_hash", "steps", "time", "momentum_error", "metrics", "contact_impulse"}) {
    EXPECT_EQ(resumed[key], whole[key]) << key;
  }
  EXPECT_EQ(resumed["energy"]["end"], whole["energy"]["end"]);
  // The bag holds the rest of the run and the time at which it was resumed.
  rosbag::Bag bag(options_.bag);
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TypeQuery("mpm_ros/RunInfo"))) {
    const auto info = message.instantiate<RunInfo>();
    EXPECT_EQ(info->header.stamp, ros::Time(0, 17'500'000));
    EXPECT_NE(info->parameters.find("resumed_at: 0.0175"), std::string::npos) << info->parameters;
  }
  for (const rosbag::MessageInstance& message : rosbag::View(bag))
    EXPECT_GE(message.getTime(), ros::Time(0, 17'500'000));
}

// Stopped in the third sync period, after its first step: nothing can go on from there.
TEST_F(RunCheckpoint, AStateBetweenTwoSyncPointsIsNotSaved) {
  const mpm::Scene scene = mpm::load_scene(options_.scene);
  RunOptions options;
  options.threads = 1;
  bool stop = false;
  options.stop = [&stop] { return stop; };
  mpm_ros::Run run(scene, options, Stamps(), nullptr);
  run.begin();
  run.advance();
  run.advance();
  stop = true;
  EXPECT_THROW(run.advance(), mpm::StoppedError);
  try {
    run.save(folder_.file("run.h5"));
    FAIL();
  } catch (const mpm::CheckpointError& error) {
    EXPECT_NE(std::string(error.what()).find("stopped between two sync points"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(fs::exists(folder_.file("run.h5")));
}

TEST_F(RunCheckpoint, IsSavedWhereTheWorkingFolderWasRemoved) {
  const fs::path here = fs::current_path();
  fs::create_directory(folder_.file("gone"));
  fs::copy_file(options_.scene, folder_.file("gone/block.yaml"));
  fs::current_path(folder_.file("gone"));
  const mpm::Scene scene = mpm::load_scene("block.yaml");
  RunOptions options;
  options.threads = 1;
  mpm_ros::Run run(scene, options, Stamps(), nullptr);
  fs::remove_all(folder_.file("gone"));
  EXPECT_NO_THROW(run.begin());
  EXPECT_NO_THROW(run.save(folder_.file("run.h5")));
  fs::current_path(here);
  EXPECT_EQ(mpm::read_checkpoint(folder_.file("run.h5")).time, 0);
}

TEST_F(RunCheckpoint, EverySoOftenOneFileIsReplaced) {
  options_.checkpoint = folder_.file("run.h5");
  options_.checkpoint_every = "20 ms";
  // Killed, not stopped, after eighteen periods, 45 ms.
  struct Killed {};
  int asked = 0;
  EXPECT_THROW(run([&asked]() -> bool {
                 if (asked++ == 18) throw Killed();
                 return false;
               }),
               Killed);
  EXPECT_EQ(mpm::read_checkpoint(options_.checkpoint).time, 40'000'000);
  EXPECT_FALSE(fs::exists(options_.checkpoint + ".part"));
}

TEST_F(RunCheckpoint, AFailedRunLeavesItsStateWhichIsNotResumed) {
  options_.scene = data_file("leaves_domain.yaml");
  options_.end.clear();
  options_.checkpoint = folder_.file("run.h5");
  options_.checkpoint_every = "20 ms";
  ASSERT_EQ(run(), RunSceneResult::physics_failed) << err_.str();
  const std::string failed = folder_.file("run_failed.h5");
  EXPECT_NE(err_.str().find("the state of the failure is in " + failed), std::string::npos) << err_.str();
  const std::string why = mpm::read_checkpoint(failed).label.failure;
  EXPECT_NE(err_.str().find("run_scene: " + why), std::string::npos) << why;
  // The block's front starts at 0.09 m with 2 m/s and is at 0.2 m after 0.055 s: the last checkpoint is of 0.04 s.
  EXPECT_EQ(mpm::read_checkpoint(options_.checkpoint).time, 40'000'000);
  options_.checkpoint.clear();
  options_.checkpoint_every.clear();
  options_.resume = failed;
  expect_bad_input("cannot go on (" + why + ")");
}

TEST_F(RunCheckpoint, RefusesWhatMakesNoSense) {
  options_.checkpoint_every = "20 ms";
  expect_bad_input("--checkpoint-every: name the file too");
  options_.checkpoint = folder_.file("run.h5");
  options_.checkpoint_every = "-1";
  expect_bad_input("--checkpoint-every: '-1' is not between 0 and 1e9 s");
  options_.checkpoint_every = "1e300";
  expect_bad_input("--checkpoint-every: '1e300' is not between 0 and 1e9 s");
  options_.checkpoint_every = "20 mm";
  expect_bad_input("--checkpoint-every: ");
  options_.checkpoint_every.clear();
  options_.checkpoint = folder_.file("none/run.h5");
  expect_bad_input("--checkpoint " + options_.checkpoint + ": cannot be written: No such file or directory");
  options_.checkpoint.clear();
  options_.resume = folder_.file("none.h5");
  expect_bad_input("checkpoint " + options_.resume + ": no such file; check the path");
}

TEST_F(RunCheckpoint, RefusesAnotherScene) {
  options_.checkpoint = folder_.file("run.h5");
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  options_.resume = options_.checkpoint;
  options_.set = {"gravity=[0, -1.62]"};
  expect_bad_input("it is of another scene, 'falling_block'");
  EXPECT_NE(err_.str().find("in which output, metrics and the end of the run (--end) may change"), std::string::npos);
}

// Outputs and metrics are no state: a resumed run has those that it is given, and ends in the same state. Without
// time.sync the sync period goes by output.period; it stays that of the run.
TEST_F(RunCheckpoint, OutputsAndMetricsMayChange) {
  ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
  const std::string whole = summary()["state_hash"];
  options_.checkpoint = folder_.file("run.h5");
  int asked = 0;
  ASSERT_EQ(run([&asked] { return asked++ == 7; }), RunSceneResult::done) << err_.str();
  const std::string scene = options_.scene;
  options_.resume = options_.checkpoint;
  options_.checkpoint.clear();
  options_.set = {"output.particle_fields=[mises]", "output.period=7.5 ms", "output.particle_stride=2",
                  "metrics.late={mean: vz, at: 20 ms}", "metrics.steep={mean: vz, rate: {from: 20 ms, to: 50 ms}}"};
  for (const std::string& named : {std::string(), scene}) {
    options_.scene = named;
    options_.csv = folder_.file(named.empty() ? "a" : "b");
    ASSERT_EQ(run(), RunSceneResult::done) << err_.str();
    EXPECT_EQ(summary()["state_hash"], whole);
    // The block falls freely: its velocity is -g t.
    EXPECT_NEAR(summary()["metrics"]["late"], -9.81 * 0.02, 1e-6);
    EXPECT_NEAR(summary()["metrics"]["steep"], -9.81, 1e-4);
    std::ifstream table(options_.csv + "/particles_0001.csv"), index(options_.csv + "/particles.csv");
    std::string header, row;
    std::getline(table, header);
    EXPECT_EQ(header, "id [1],x [m],y [m],z [m],mises [Pa]");
    std::vector<std::string> times;
    while (std::getline(index, row)) times.push_back(row.substr(row.find(',') + 1, row.rfind(',') - row.find(',') - 1));
    EXPECT_EQ(times, (std::vector<std::string>{"time [s]", "0.0175", "0.0225", "0.03", "0.0375", "0.045", "0.05"}));
  }
  options_.csv.clear();
  const auto refused = [this](const std::string& change, const std::string& why) {
    options_.set = {change};
    expect_bad_input(why);
  };
  refused("output.period=6 ms", "output.period: 0.006 s is not a whole number of sync periods of 0.0025 s");
  refused("time.sync=1.25 ms", "time.sync is 0.0025 s there and 0.00125 s here");
  refused("metrics.early={mean: vz, at: 10 ms}", "metrics.early: it looks at t = 0.01 s, and the run goes on from");
  refused("output.particle_fields=[ux]", "do not remember where they were at the start");
}

/// Queues a velocity for a later time; two poses, of which the second begins when the first is reached; and a velocity
/// without a stamp.
void fill(CommandQueue& queue) {
  BodyCommand command;
  command.body = 1;
  command.twist.linear.z() = -0.1;
  command.stamp = 60'000'000;
  command.requested = ros::Time(0, 60'000'000);
  queue.push(command);
  command.body = 0;
  command.kind = CommandKind::pose;
  command.pose.position = {0.1, 0.0, 0.055};
  command.stamp = 120'000'000;
  queue.push(command);
  command.pose.position.z() = 0.052;
  command.stamp = 160'000'000;
  queue.push(command);
  command.kind = CommandKind::velocity;
  command.body = 1;
  command.stamp.reset();
  command.late = true;
  queue.push(command);
}

/// A run of the press with commands that wait in the queue, to the end or to a sync point.
struct Pressed {
  explicit Pressed(const std::string& resume = {}) : queue(scene.definition.time.sync) {
    RunOptions options;
    options.threads = 1;
    options.output = output_options(scene);
    options.output.wrench_period = 0.016;  // averages of eight periods
    options.resume = resume;
    options.more = [this](mpm::StateArchive& archive) { serialise(archive); };
    run = std::make_unique<mpm_ros::Run>(scene, options, Stamps(), nullptr);
    run->begin();
  }
  void serialise(mpm::StateArchive& archive) {
    queue.serialise(archive);
    watch.serialise(archive);
    limiter.serialise(archive);
    turning.serialise(archive);
    const mpm::StateArchive::Group group(archive, "joints");
    joints.serialise(archive);
  }
  void go(int periods) {
    for (int n = 0; n < periods && !run->ended(); ++n) {
      const std::int64_t now = run->simulation().time();
      for (const DueCommand& due : queue.take(now)) {
        AppliedCommand command;
        command.body = due.command.body;
        command.kind = due.command.kind;
        command.twist = due.command.twist;
        command.pose = due.command.pose;
        command.effect = now;
        command.arrival = due.arrival;
        run->apply(command);
        watch.heard(command);
      }
      silences += static_cast<int>(watch.silent(now).size());
      run->advance();
    }
  }
  mpm::Scene scene = mpm::load_scene(data_file("press.yaml"));
  CommandQueue queue;
  CommandWatch watch{30'000'000};
  NodeHealth health;
  CommandLimiter limiter{{}, health};
  TurningTwists turning;
  JointQueue joints;
  std::unique_ptr<mpm_ros::Run> run;
  int silences = 0;
};

TEST_F(RunCheckpoint, CommandsThatWaitAndAveragesUnderWayGoOn) {
  Pressed whole;
  fill(whole.queue);
  whole.go(1000000);
  ASSERT_TRUE(whole.run->ended());
  EXPECT_EQ(whole.queue.waiting(), 0U);
  for (const int at : {0, 1, 35, 64}) {  // before, between and after commands, and within averages
    Pressed first;
    fill(first.queue);
    first.go(at);
    first.run->save(folder_.file("press.h5"), [&](mpm::StateArchive& archive) { first.serialise(archive); });
    Pressed second(folder_.file("press.h5"));
    EXPECT_EQ(second.queue.waiting(), first.queue.waiting());
    second.go(1000000);
    EXPECT_EQ(second.run->simulation().memory_hash(), whole.run->simulation().memory_hash()) << at;
    EXPECT_EQ(first.silences + second.silences, whole.silences) << at;
    EXPECT_EQ(second.run->outputs().solver_state().commands_applied,
              whole.run->outputs().solver_state().commands_applied);
  }
}

TEST_F(RunCheckpoint, RunSceneDoesNotDropCommandsThatWait) {
  Pressed first;
  fill(first.queue);
  JointOrder order;
  order.joints = {"boom", "arm"};
  order.values = {0.1, 0.2};
  order.stamp = 1'000'000'000;
  first.joints.push(order);
  first.go(1);
  first.run->save(folder_.file("press.h5"), [&](mpm::StateArchive& archive) { first.serialise(archive); });
  options_.scene.clear();
  options_.end.clear();
  options_.resume = folder_.file("press.h5");
  expect_bad_input("3 commands that wait for their time");
  Pressed second(folder_.file("press.h5"));
  const std::vector<JointOrder> due = second.joints.take(1'000'000'000);
  ASSERT_EQ(due.size(), 1u);
  EXPECT_EQ(due[0].joints, order.joints);
  EXPECT_EQ(due[0].values, order.values);
}

}  // namespace run_checkpoint_test
}  // namespace mpm_ros
