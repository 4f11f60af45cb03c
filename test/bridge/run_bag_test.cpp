// A run with its bag, without a master: its recorded messages, and the same state again from the recorded commands.
#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <set>

#include "mpm_ros/command/command_log.hpp"
#include "mpm_ros/record/output_names.hpp"
#include "mpm_ros/report/report_plots.hpp"
#include "mpm_ros/run/run.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace run_bag_test {

mpm::Scene press() { return mpm::load_scene(data_file("press.yaml")); }

AppliedCommand push_down(const Run& run, double speed) {
  AppliedCommand command;
  command.body = run.simulation().find_body("plate");
  command.twist.linear.z() = -speed;
  command.effect = run.simulation().time();
  return command;
}

RunOptions options_for(const mpm::Scene& scene, const std::string& bag, int threads) {
  RunOptions options;
  options.threads = threads;
  options.output = output_options(scene);
  options.bag = bag;
  return options;
}

/// Presses for the whole run, with a change of speed and then of the kind of command; returns the state hash at the
/// end.
std::uint64_t press_run(const std::string& bag, int threads) {
  const mpm::Scene scene = press();
  mpm_ros::Run run(scene, options_for(scene, bag, threads), Stamps(), nullptr);
  run.begin();
  run.apply(push_down(run, 0.1));
  bool slowed = false;
  bool posed = false;
  while (!run.ended()) {
    if (!slowed && run.simulation().time() >= 80'000'000) {
      run.apply(push_down(run, 0.03));
      slowed = true;
    }
    if (!posed && run.simulation().time() >= 120'000'000) {
      AppliedCommand command = push_down(run, 0.0);
      command.kind = CommandKind::pose;
      command.twist = {};
      command.pose.position = {0.1, 0.0, 0.06};
      command.arrival = command.effect + 5 * run.simulation().sync_period();
      run.apply(command);
      posed = true;
    }
    run.advance();
  }
  run.finish();
  return run.simulation().state_hash();
}

std::uint64_t replay_run(const std::string& bag, int threads) {
  const mpm::Scene scene = press();
  mpm_ros::Run run(scene, options_for(scene, "", threads), Stamps(), nullptr);
  CommandLog log = read_commands(bag);
  EXPECT_EQ(log.size(), 3U);
  run.begin();
  while (!run.ended()) {
    for (const AppliedCommand& command : log.take(run.simulation())) run.apply(command);
    run.advance();
  }
  run.finish();
  return run.simulation().state_hash();
}

TEST(RunBag, RecordedCommandsGiveTheSameHashWithAnyNumberOfThreads) {
  const TemporaryFolder folder;
  const std::uint64_t hash = press_run(folder.file("one.bag"), 1);
  EXPECT_EQ(press_run("", 2), hash);
  EXPECT_EQ(replay_run(folder.file("one.bag"), 1), hash);
  EXPECT_EQ(replay_run(folder.file("one.bag"), 2), hash);
}

TEST(RunBag, HoldsEverythingFromTheStartOn) {
  const TemporaryFolder folder;
  press_run(folder.file("run.bag"), 1);
  rosbag::Bag bag(folder.file("run.bag"));
  rosbag::View view(bag);
  std::map<std::string, int> count;
  std::map<std::string, ros::Time> first;
  std::map<std::string, std::string> type;
  std::string last_hash;
  for (const rosbag::MessageInstance& message : view) {
    if (count[message.getTopic()]++ == 0) first[message.getTopic()] = message.getTime();
    type[message.getTopic()] = message.getDataType();
    if (const auto state = message.instantiate<SolverState>()) last_hash = state->state_hash;
  }
  const mpm::Scene scene = press();
  const int syncs = static_cast<int>(std::llround(scene.definition.time.end * 1e9 / scene.definition.time.sync));
  EXPECT_EQ(count["/mpm/contact_forces"], syncs + 1);
  EXPECT_EQ(count["/mpm/bodies/plate/wrench"], syncs + 1);
  EXPECT_EQ(count["/mpm/bodies/rod/wrench"], syncs + 1);
  EXPECT_EQ(count["/mpm/bodies"], syncs + 1);
  EXPECT_EQ(count["/mpm/solver_state"], syncs + 1);
  EXPECT_EQ(count["/tf"], syncs + 1);
  EXPECT_EQ(count["/mpm/particles"], 11);  // every 0.02 s of 0.2 s, and at the start
  EXPECT_EQ(count["/mpm/commands"], 3);
  EXPECT_EQ(count["/mpm/run_info"], 1);
  EXPECT_EQ(count["/mpm/markers"], 1);
  for (const char* topic : {"/mpm/run_info", "/mpm/markers", "/mpm/contact_forces", "/mpm/particles", "/tf"}) {
    EXPECT_EQ(first[topic], ros::TIME_MIN) << topic;
  }
  EXPECT_EQ(type["/mpm/contact_forces"], "mpm_ros/ContactForces");
  EXPECT_EQ(type["/mpm/particles"], "sensor_msgs/PointCloud2");
  EXPECT_EQ(last_hash.size(), 16U);
}

TEST(RunBag, ForceMeansImpulseOverTime) {
  const TemporaryFolder folder;
  press_run(folder.file("run.bag"), 1);
  rosbag::Bag bag(folder.file("run.bag"));
  rosbag::View view(bag, rosbag::TopicQuery("/mpm/contact_forces"));
  double sum = 0.0;
  double impulse = 0.0;
  double largest = 0.0;
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = instance.instantiate<ContactForces>();
    ASSERT_EQ(message->bodies.size(), 2U);
    EXPECT_EQ(message->bodies[1].impulse.z, 0.0);  // the rod touches nothing
    sum += message->bodies[0].wrench.force.z * message->bodies[0].interval;
    impulse = message->bodies[0].impulse.z;
    largest = std::max(largest, message->bodies[0].wrench.force.z);
  }
  // The strip pushes the plate up as soon as they touch.
  EXPECT_GT(largest, 0.0);
  // Both are sums of the same impulses in another order and differ by round-off of some thousand additions.
  EXPECT_NEAR(sum, impulse, 1e-10 * std::abs(impulse));
}

TEST(RunBag, StaticTopicsAreLatched) {
  const TemporaryFolder folder;
  press_run(folder.file("run.bag"), 1);
  rosbag::Bag bag(folder.file("run.bag"));
  rosbag::View view(bag);
  std::set<std::string> latched;
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
    const auto entry = connection->header->find("latching");
    if (entry != connection->header->end() && entry->second == "1") latched.insert(connection->topic);
  }
  EXPECT_EQ(latched, (std::set<std::string>{"/mpm/markers", "/mpm/run_info"}));
}

TEST(RunBag, AFolderThatCannotBeWrittenIsOneLine) {
  const auto error_of = [](const std::string& path) -> std::string {
    try {
      BagRecorder recorder(path);
    } catch (const BagError& error) {
      return error.what();
    }
    return {};
  };
  const std::string missing = error_of("/no/such/folder/run.bag");
  EXPECT_NE(missing.find("/no/such/folder"), std::string::npos);
  EXPECT_EQ(missing.find('\n'), std::string::npos);
  if (geteuid() != 0) {  // root may write everywhere
    const TemporaryFolder folder;
    chmod(folder.path().c_str(), 0500);
    EXPECT_NE(error_of(folder.file("run.bag")).find("not writable"), std::string::npos);
    chmod(folder.path().c_str(), 0700);
  }
}

TEST(RunBag, ABagWithoutCommandsCannotBeReplayed) {
  const TemporaryFolder folder;
  { BagRecorder recorder(folder.file("empty.bag")); }
  EXPECT_THROW(read_commands(folder.file("empty.bag")), BagError);
  EXPECT_THROW(read_commands(folder.file("missing.bag")), BagError);
}

TEST(RunBag, CommandsOfAnotherSceneAreRefused) {
  const mpm::Scene scene = press();
  mpm_ros::Run run(scene, options_for(scene, "", 1), Stamps(), nullptr);
  mpm_ros::Command stranger;
  stranger.body = "shovel";
  stranger.kind = mpm_ros::Command::VELOCITY;
  CommandLog log({stranger});
  EXPECT_THROW(log.take(run.simulation()), BagError);
}

TEST(RunBag, NamesOfBags) {
  EXPECT_EQ(bag_path("/tmp/a.bag", "press", 1), "/tmp/a.bag");
  EXPECT_EQ(bag_path("/tmp/a.bag", "press", 2), "/tmp/a_2.bag");
  const std::string named = bag_path("auto", "press", 1);
  EXPECT_EQ(named.compare(0, 12, "./mpm_press_"), 0) << named;
}

}  // namespace run_bag_test
}  // namespace mpm_ros
