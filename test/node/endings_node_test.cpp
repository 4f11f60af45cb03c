// Ends of the node, by the wall clock: the scene's end, signals, failed physics, silence, bad input. The bag is
// readable in every case.
#include <geometry_msgs/Twist.h>
#include <mpm_ros/BodyStates.h>
#include <mpm_ros/SolverState.h>
#include <std_srvs/SetBool.h>

#include <fstream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "simulator_process.hpp"
#include "test_files.hpp"

namespace mpm_ros::test {
namespace endings_node_test {

const std::string kPress = "scene:=" + data_file("press.yaml");

/// Messages of a type in a bag; throws when rosbag cannot open it.
std::size_t messages_in(const std::string& path, const std::string& type) {
  rosbag::Bag bag(path);
  return rosbag::View(bag, rosbag::TypeQuery(type)).size();
}

void expect_closed_bag_after(int signal) {
  const TemporaryFolder folder;
  const std::string bag = folder.file("run.bag");
  SimulatorProcess simulator({kPress, "pacing:=real_time", "threads:=1", "set:=[time.end=1000]", "record:=" + bag});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<BodyStates> bodies(simulator.name("bodies"));
  ASSERT_TRUE(bodies.hears(5)) << simulator.log();
  simulator.signal(signal);
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  EXPECT_EQ(messages_in(bag, "mpm_ros/RunInfo"), 1U);
  EXPECT_GE(messages_in(bag, "mpm_ros/BodyStates"), 5U);
  EXPECT_EQ(hash_in(bag).size(), 16U);  // the last state is recorded
}

TEST(Endings, InterruptClosesTheBag) { expect_closed_bag_after(SIGINT); }

TEST(Endings, TerminationClosesTheBag) { expect_closed_bag_after(SIGTERM); }

TEST(Endings, InterruptWhilePausedClosesTheBag) {
  const TemporaryFolder folder;
  const std::string bag = folder.file("run.bag");
  SimulatorProcess simulator({kPress, "threads:=1", "start_paused:=true", "record:=" + bag});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  simulator.signal(SIGINT);
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  EXPECT_EQ(messages_in(bag, "mpm_ros/BodyStates"), 1U);  // the state at the start
}

TEST(Endings, TheScenesEndIsExitCodeZero) {
  const TemporaryFolder folder;
  const std::string bag = folder.file("run.bag");
  SimulatorProcess simulator({kPress, "pacing:=free", "threads:=1", "record:=" + bag});
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  EXPECT_EQ(hash_in(bag).size(), 16U);
  EXPECT_FALSE(last_state_in(bag).failed);
}

TEST(Endings, FailedPhysicsIsExitCodeThreeAndLeavesABag) {
  const TemporaryFolder folder;
  const std::string bag = folder.file("run.bag");
  SimulatorProcess simulator(
      {"scene:=" + data_file("leaves_domain.yaml"), "pacing:=free", "threads:=1", "record:=" + bag});
  EXPECT_EQ(simulator.wait(), 3) << simulator.log();
  const std::vector<std::string> lines = simulator.fatal_lines();
  ASSERT_EQ(lines.size(), 1U) << simulator.log();
  EXPECT_NE(lines[0].find("particle"), std::string::npos) << lines[0];
  EXPECT_NE(lines[0].find("step"), std::string::npos) << lines[0];
  // The block's front starts at 0.09 m with 2 m/s and leaves the domain at 0.2 m after 0.06 s at the latest, so there
  // are snapshots of 0, 0.02 and 0.04 s, and of the failure.
  EXPECT_GE(messages_in(bag, "sensor_msgs/PointCloud2"), 4U);
  EXPECT_EQ(hash_in(bag).size(), 16U);
  // The bag alone shows that the run failed, and why.
  const SolverState last = last_state_in(bag);
  EXPECT_TRUE(last.failed);
  EXPECT_NE(lines[0].find(last.failure), std::string::npos) << last.failure;
}

void expect_bad_input(const std::vector<std::string>& parameters, const std::string& text) {
  SimulatorProcess simulator(parameters);
  EXPECT_EQ(simulator.wait(), 2) << simulator.log();
  const std::vector<std::string> lines = simulator.fatal_lines();
  ASSERT_EQ(lines.size(), 1U) << simulator.log();
  EXPECT_NE(lines[0].find(text), std::string::npos) << lines[0];
}

TEST(Endings, SceneNotGiven) { expect_bad_input({}, "~scene is not given"); }

TEST(Endings, SceneThatIsNotThere) { expect_bad_input({"scene:=no_such_scene"}, "no_such_scene"); }

TEST(Endings, BadOverride) { expect_bad_input({kPress, "set:=[grid.cel=0.01]"}, "cel"); }

TEST(Endings, BadPacing) { expect_bad_input({kPress, "pacing:=fast"}, "~pacing"); }

TEST(Endings, BadDevice) { expect_bad_input({kPress, "device:=cuda"}, "~device: cuda: there is no processor"); }

TEST(Endings, BadParticleField) { expect_bad_input({kPress, "particle_fields:=vxx"}, "vxx"); }

TEST(Endings, BagThatCannotBeWritten) {
  expect_bad_input({kPress, "record:=/no/such/folder/run.bag"}, "/no/such/folder");
}

TEST(Endings, CommandsThatAreNotThere) { expect_bad_input({kPress, "commands:=/no/such.bag"}, "/no/such.bag"); }

TEST(Endings, MisspeltParameterIsWarnedOf) {
  SimulatorProcess simulator({kPress, "pacing:=free", "threads:=1", "recrd:=x"});
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  EXPECT_NE(simulator.log().find("~recrd is not known"), std::string::npos) << simulator.log();
  EXPECT_NE(simulator.log().find("'record'"), std::string::npos) << simulator.log();
}

TEST(Endings, StampsCountFromTheWallTimeOfTheStart) {
  const ros::WallTime before = ros::WallTime::now();
  SimulatorProcess simulator({kPress, "start_paused:=true", "threads:=1"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<SolverState> state(simulator.name("solver_state"));
  ASSERT_TRUE(state.hears(1));
  EXPECT_GE(state.heard()[0].header.stamp.toSec(), before.toSec() - 1e-3);
  EXPECT_LE(state.heard()[0].header.stamp.toSec(), ros::WallTime::now().toSec());
}

TEST(Endings, PauseHoldsSimulatedTimeAndCommandsAreTakenAfterwards) {
  SimulatorProcess simulator(
      {kPress, "threads:=1", "start_paused:=true", "set:=[time.end=1000]", "real_time_factor:=0.5"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<BodyStates> bodies(simulator.name("bodies"));
  ASSERT_TRUE(bodies.connected());
  ros::Publisher publisher = ros::NodeHandle().advertise<geometry_msgs::Twist>(simulator.name("bodies/rod/cmd_vel"), 1);
  ASSERT_TRUE(eventually([&] { return publisher.getNumSubscribers() > 0; }));
  geometry_msgs::Twist up;
  up.linear.z = 0.01;
  publisher.publish(up);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_TRUE(bodies.heard().empty());  // nothing moves while paused

  std_srvs::SetBool pause;
  pause.request.data = 0;
  ASSERT_TRUE(simulator.call("pause", pause));
  ASSERT_TRUE(bodies.hears(3)) << simulator.log();
  EXPECT_EQ(bodies.heard().back().bodies[1].drive, BodyState::VELOCITY);
  EXPECT_EQ(bodies.heard().back().bodies[1].twist.linear.z, 0.01);
  Step step;
  ASSERT_TRUE(simulator.call("step", step));
  EXPECT_FALSE(step.response.success);  // not in lockstep
}

TEST(Endings, SilenceStopsTheBody) {
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1", "command_timeout:=0.05", "on_timeout:=stop"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  ASSERT_TRUE(diagnostics.connected());
  Step::Request request;
  request.duration = 0.1;
  request.commands.push_back(velocity("rod", -0.1));
  const Step::Response response = simulator.step(request);
  ASSERT_TRUE(response.success);
  // It moved for 0.05 s and then stood still.
  EXPECT_NEAR(response.bodies.bodies[1].pose.position.z, 0.1 - 0.1 * 0.05, 1e-12);
  EXPECT_EQ(response.bodies.bodies[1].twist.linear.z, 0.0);
  EXPECT_TRUE(diagnosed(diagnostics, simulator, "no command for 'rod'"));
}

TEST(Endings, SilenceHoldsTheTwistByDefault) {
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1", "command_timeout:=0.05"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Step::Request request;
  request.duration = 0.1;
  request.commands.push_back(velocity("rod", -0.1));
  const Step::Response response = simulator.step(request);
  ASSERT_TRUE(response.success);
  EXPECT_NEAR(response.bodies.bodies[1].pose.position.z, 0.1 - 0.1 * 0.1, 1e-12);
}

TEST(Endings, SilenceCanEndTheRun) {
  SimulatorProcess simulator(
      {kPress, "pacing:=lockstep", "threads:=1", "command_timeout:=0.05", "on_timeout:=error", "keep_alive:=false"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Step::Request request;
  request.duration = 0.1;
  request.commands.push_back(velocity("rod", -0.1));
  const Step::Response response = simulator.step(request);
  EXPECT_FALSE(response.success);
  EXPECT_NE(response.message.find("no command for 'rod'"), std::string::npos);
  EXPECT_NEAR(response.time, 0.05, 1e-9);
  EXPECT_EQ(simulator.wait(), 3) << simulator.log();
}

bool says(const ProgramProcess& program, const std::string& text) {
  return eventually([&] { return program.log().find(text) != std::string::npos; });
}

/// Wall time that a program takes to end after a signal [s]; infinite when it does not within a minute.
double time_to_end(ProgramProcess& program, int signal, int& exit_code) {
  const auto asked = std::chrono::steady_clock::now();
  program.signal(signal);
  exit_code = program.wait();
  return exit_code == -1 ? std::numeric_limits<double>::infinity()
                         : std::chrono::duration<double>(std::chrono::steady_clock::now() - asked).count();
}

TEST(Endings, HangUpClosesTheBag) { expect_closed_bag_after(SIGHUP); }

/// With a master that is gone, or that does not answer: it ends within 2 s, with its bag closed.
void expect_ends_without_master(int to_master, int to_node) {
  const TemporaryFolder folder;
  const std::string bag = folder.file("run.bag"), port = std::to_string(21600 + getpid() % 300);
  auto master = std::make_unique<ProgramProcess>("rosmaster", std::vector<std::string>{"--core", "-p", port}, kNoNode);
  SimulatorProcess simulator(
      {kPress, "threads:=1", "set:=[time.end=1000]", "record:=" + bag, "_master:=http://localhost:" + port});
  ASSERT_TRUE(says(simulator, "recording to")) << simulator.log();
  std::this_thread::sleep_for(std::chrono::seconds(1));
  master->signal(to_master);
  // The node looks for topics of strangers each second.
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  int exit_code = 0;
  EXPECT_LT(time_to_end(simulator, to_node, exit_code), 2.0);
  EXPECT_EQ(exit_code, 0) << simulator.log();
  EXPECT_EQ(hash_in(bag).size(), 16U);
}

TEST(Endings, InterruptWithoutMaster) { expect_ends_without_master(SIGKILL, SIGINT); }

TEST(Endings, TerminationWhileTheMasterHangs) { expect_ends_without_master(SIGSTOP, SIGTERM); }

// Nobody stops it: it ends by itself after 4 s, and does not wait for the master longer than five. Cost: 10 s.
TEST(Endings, ARunThatIsOverWhileTheMasterHangs) {
  const TemporaryFolder folder;
  const std::string bag = folder.file("run.bag"), port = std::to_string(21900 + getpid() % 300);
  ProgramProcess master("rosmaster", {"--core", "-p", port}, kNoNode);
  SimulatorProcess simulator({kPress, "threads:=1", "set:=[time.end=4]", "keep_alive:=false", "record:=" + bag,
                              "_master:=http://localhost:" + port});
  ASSERT_TRUE(says(simulator, "recording to")) << simulator.log();
  std::this_thread::sleep_for(std::chrono::seconds(1));
  master.signal(SIGSTOP);
  int exit_code = 0;
  EXPECT_LT(time_to_end(simulator, 0, exit_code), 12.0);
  EXPECT_EQ(exit_code, 0) << simulator.log();
  EXPECT_EQ(hash_in(bag).size(), 16U);
}

// Ten thousand steps of settling that never satisfies it, some 40 s; it says how far it is every three seconds.
TEST(Endings, SignalsEndAGeostaticStart) {
  const std::string endless = R"(bodies.bed.initial={"geostatic":{"residual":1e-15}})";
  int exit_code = 0;
  SimulatorProcess simulator({"scene:=cone_penetrometer", "threads:=1", "set:=" + endless});
  ASSERT_TRUE(says(simulator, "steps of settling the unbalanced force is")) << simulator.log();
  EXPECT_LT(time_to_end(simulator, SIGINT, exit_code), 1.5);  // a second, and leaving the graph
  EXPECT_EQ(exit_code, 0) << simulator.log();

  for (const bool explain : {false, true}) {
    std::vector<std::string> arguments{"cone_penetrometer", "--threads", "1", "--set", endless};
    if (explain) arguments.push_back("--explain");
    ProgramProcess run("run_scene", arguments, kNoNode);
    ASSERT_TRUE(says(run, "steps of settling the unbalanced force is")) << run.log();
    EXPECT_LT(time_to_end(run, explain ? SIGHUP : SIGTERM, exit_code), 1.0);
    EXPECT_EQ(exit_code, 0) << run.log();
    EXPECT_NE(run.log().find("stopped while 'bed' settled"), std::string::npos) << run.log();
  }
}

// One sync period of 2,000 s simulated, some four million steps.
TEST(Endings, SignalsActWithinALongSyncPeriod) {
  const TemporaryFolder folder;
  const std::string bag = folder.file("run.bag"), checkpoint = folder.file("run.h5");
  const std::string summary = folder.file("summary.json");
  int exit_code = 0;
  ProgramProcess run("run_scene",
                     {data_file("press.yaml"), "--threads", "1", "--set", "time.end=4000", "--set", "time.sync=2000",
                      "--set", "output.period=2000", "--bag", bag, "--checkpoint", checkpoint, "--summary", summary},
                     kNoNode);
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(bag) && std::filesystem::file_size(bag) > 10'000; }));
  // The start is recorded before the first step; on a slow disk the signal came in between.
  const double loaded = run.processor_seconds();
  ASSERT_TRUE(eventually([&] { return run.processor_seconds() > loaded + 0.5; })) << run.log();
  EXPECT_LT(time_to_end(run, SIGINT, exit_code), 1.0);
  EXPECT_EQ(exit_code, 1) << run.log();  // a checkpoint was asked for
  EXPECT_NE(run.log().find("stopped within a sync period"), std::string::npos) << run.log();
  EXPECT_NE(run.log().find("not written, since the run was stopped between two sync points"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(checkpoint));
  std::ifstream file(summary);
  const nlohmann::json told = nlohmann::json::parse(file);
  EXPECT_TRUE(told.at("cut_short").get<bool>());
  EXPECT_FALSE(told.contains("state_hash"));
  EXPECT_EQ(messages_in(bag, "mpm_ros/BodyStates"), 1U);  // the start
}

TEST(Endings, TooManyThreadsAreRefused) { expect_bad_input({kPress, "threads:=99999"}, "99999 threads are asked for"); }

}  // namespace endings_node_test
}  // namespace mpm_ros::test
