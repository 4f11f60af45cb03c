// Checkpoints of the node: saved, loaded by the same node and by another one, with commands that are not due yet; wrong
// files are refused, and a failed run saves its state.
#include <geometry_msgs/TwistStamped.h>
#include <mpm_ros/Checkpoint.h>

#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm_ros/message/conversions.hpp"
#include "process_memory.hpp"
#include "simulator_process.hpp"
#include "test_files.hpp"

namespace mpm_ros::test {
namespace checkpoint_node_test {

const std::string kPress = "scene:=" + data_file("press.yaml");
constexpr std::uint32_t kWhole = 60, kHalf = 25;  // sync periods of 2 ms

Checkpoint::Response call(const SimulatorProcess& simulator, const std::string& service, const std::string& path) {
  Checkpoint message;
  message.request.path = path;
  EXPECT_TRUE(simulator.call(service, message)) << simulator.log();
  return message.response;
}

std::vector<std::string> lockstep(const std::vector<std::string>& more) {
  std::vector<std::string> parameters{kPress, "pacing:=lockstep", "threads:=1"};
  parameters.insert(parameters.end(), more.begin(), more.end());
  return parameters;
}

/// A pose that is to be reached long after the checkpoint.
mpm_ros::Command press_down() {
  mpm_ros::Command command;
  command.body = "plate";
  command.kind = mpm_ros::Command::POSE;
  command.pose.position.x = 0.1;
  command.pose.position.z = 0.055;
  command.pose.orientation.w = 1.0;
  return command;
}

std::string hash_of_end(SimulatorProcess& simulator, const std::string& bag) {
  simulator.signal(SIGINT);
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  return hash_in(bag);
}

TEST(CheckpointNode, ThroughACheckpointEqualsUninterrupted) {
  const TemporaryFolder folder;
  const std::string file = folder.file("half.h5");
  ros::Time last;
  std::string whole;
  {
    SimulatorProcess simulator(lockstep({"record:=" + folder.file("whole.bag")}));
    ASSERT_TRUE(simulator.ready()) << simulator.log();
    ASSERT_TRUE(simulator.step(kHalf, {press_down()}).success);
    ASSERT_TRUE(simulator.step(kWhole - kHalf, {velocity("plate", -0.05)}).success);
    whole = hash_of_end(simulator, folder.file("whole.bag"));
  }
  {
    SimulatorProcess simulator(lockstep({"record:=" + folder.file("run.bag")}));
    ASSERT_TRUE(simulator.ready()) << simulator.log();
    ASSERT_TRUE(simulator.step(kHalf, {press_down()}).success);
    const Checkpoint::Response saved = call(simulator, "save_checkpoint", file);
    ASSERT_TRUE(saved.success) << saved.message;
    EXPECT_EQ(saved.path, file);
    EXPECT_NEAR(saved.time, 0.002 * kHalf, 1e-12);
    EXPECT_EQ(saved.state_hash, hash_text(mpm::read_checkpoint(file).state_hash));
    // It moves elsewhere and loads the checkpoint: simulated time jumps back, stamps do not.
    last = simulator.step(10, {velocity("plate", 0.3)}).stamp;
    const Checkpoint::Response loaded = call(simulator, "load_checkpoint", file);
    ASSERT_TRUE(loaded.success) << loaded.message;
    EXPECT_EQ(loaded.time, saved.time);
    EXPECT_EQ(loaded.state_hash, saved.state_hash);
    EXPECT_GT(loaded.stamp, last);
    const Step::Response end = simulator.step(kWhole - kHalf, {velocity("plate", -0.05)});
    ASSERT_TRUE(end.success) << end.message;
    EXPECT_NEAR(end.time, 0.002 * kWhole, 1e-12);
    EXPECT_GT(end.stamp, loaded.stamp);
    // A bag holds one run.
    EXPECT_EQ(hash_of_end(simulator, folder.file("run_2.bag")), whole);
  }
  {
    SimulatorProcess simulator(lockstep({"record:=" + folder.file("rest.bag"), "resume:=" + file}));
    ASSERT_TRUE(simulator.ready()) << simulator.log();
    ASSERT_TRUE(simulator.step(kWhole - kHalf, {velocity("plate", -0.05)}).success);
    EXPECT_EQ(hash_of_end(simulator, folder.file("rest.bag")), whole);
  }
}

TEST(CheckpointNode, CommandsThatWaitAreSavedAndGoOn) {
  const TemporaryFolder folder;
  const std::string file = folder.file("waiting.h5");
  ros::NodeHandle node;
  SimulatorProcess simulator(lockstep({"record:=" + folder.file("run.bag")}));
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<mpm_ros::Command> commands(simulator.name("commands"));
  ASSERT_TRUE(commands.connected());
  ros::Publisher velocities =
      node.advertise<geometry_msgs::TwistStamped>(simulator.name("bodies/plate/cmd_vel_stamped"), 10);
  ASSERT_TRUE(eventually([&] { return velocities.getNumSubscribers() > 0; }));
  const Step::Response start = simulator.step(5);
  // A command that takes effect twenty periods later.
  geometry_msgs::TwistStamped later;
  later.header.stamp = start.stamp + ros::Duration(0.04);
  later.twist.linear.z = -0.1;
  velocities.publish(later);
  ros::WallDuration(0.5).sleep();  // time for the message to arrive; simulated time stands still
  const Checkpoint::Response saved = call(simulator, "save_checkpoint", file);
  ASSERT_TRUE(saved.success) << saved.message;
  ASSERT_TRUE(simulator.step(50).success);
  ASSERT_TRUE(commands.hears(1));
  const Checkpoint::Response loaded = call(simulator, "load_checkpoint", file);
  ASSERT_TRUE(loaded.success) << loaded.message;
  ASSERT_TRUE(simulator.step(50).success);
  ASSERT_TRUE(commands.hears(2));
  const std::vector<mpm_ros::Command> heard = commands.heard();
  EXPECT_EQ(heard[1].effect_ns, heard[0].effect_ns);
  EXPECT_EQ(heard[0].effect_ns, 50'000'000);  // 10 ms and 40 ms
  EXPECT_EQ(heard[1].twist.linear.z, -0.1);
  EXPECT_EQ(hash_of_end(simulator, folder.file("run_2.bag")), hash_in(folder.file("run.bag")));
}

TEST(CheckpointNode, WrongFilesAreRefusedAndTheRunGoesOn) {
  const TemporaryFolder folder;
  SimulatorProcess simulator(lockstep({}));
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  ASSERT_TRUE(simulator.step(3).success);
  EXPECT_NE(call(simulator, "load_checkpoint", folder.file("none.h5")).message.find("no such file"), std::string::npos);
  std::ofstream(folder.file("text.h5")) << "no checkpoint\n";
  const Checkpoint::Response refused = call(simulator, "load_checkpoint", folder.file("text.h5"));
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("it is no HDF5 file"), std::string::npos) << refused.message;
  EXPECT_FALSE(call(simulator, "save_checkpoint", "").success);
  EXPECT_FALSE(call(simulator, "save_checkpoint", folder.file("none/run.h5")).success);
  const Step::Response next = simulator.step(1);
  EXPECT_TRUE(next.success);
  EXPECT_NEAR(next.time, 0.008, 1e-12);
}

// A hundred refused checkpoints held 240 MB, and the node then ended in a segmentation fault of HDF5.
TEST(CheckpointNode, AFullDiskCostsTheNodeNothing) {
  const TemporaryFolder folder;
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1"}, 20'000);
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  double before = 0.0;
  for (int i = 0; i < 110; ++i) {
    const Checkpoint::Response refused = call(simulator, "save_checkpoint", folder.file("run.h5"));
    ASSERT_FALSE(refused.success);
    EXPECT_NE(refused.message.find("cannot be written whole (File too large)"), std::string::npos) << refused.message;
    if (i == 9) before = memory_of(simulator.pid());
  }
  EXPECT_LT(memory_of(simulator.pid()) - before, 0.02 * before);
  EXPECT_TRUE(simulator.step(1).success);
  simulator.signal(SIGINT);
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  EXPECT_EQ(simulator.log().find("HDF5"), std::string::npos) << simulator.log();
}

TEST(CheckpointNode, AFailedRunLeavesItsState) {
  const TemporaryFolder folder;
  SimulatorProcess simulator(
      {"scene:=" + data_file("leaves_domain.yaml"), "pacing:=free", "threads:=1", "record:=" + folder.file("run.bag")});
  EXPECT_EQ(simulator.wait(), 3) << simulator.log();
  const std::string file = folder.file("run_failed.h5");
  EXPECT_NE(simulator.log().find("the state of the failure is in " + file), std::string::npos) << simulator.log();
  const mpm::CheckpointAbout about = mpm::read_checkpoint(file);
  EXPECT_EQ(about.label.failure, last_state_in(folder.file("run.bag")).failure);
  SimulatorProcess again({"scene:=" + data_file("leaves_domain.yaml"), "resume:=" + file});
  EXPECT_EQ(again.wait(), 2) << again.log();
  EXPECT_NE(again.log().find("cannot go on"), std::string::npos) << again.log();
}

}  // namespace checkpoint_node_test
}  // namespace mpm_ros::test
