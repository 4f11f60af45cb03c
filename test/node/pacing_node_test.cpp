// Pacing of simulated time, /clock, starting paused, and the effect of a reset on time. The parameter /use_sim_time is
// set for each simulator.
#include <geometry_msgs/TwistStamped.h>
#include <mpm_ros/BodyStates.h>
#include <mpm_ros/Command.h>
#include <mpm_ros/RunInfo.h>
#include <mpm_ros/SolverState.h>
#include <rosgraph_msgs/Clock.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cstring>

#include "simulator_process.hpp"
#include "test_files.hpp"

namespace mpm_ros::test {
namespace pacing_node_test {

const std::string kPress = "scene:=" + data_file("press.yaml");
const std::string kLong = "set:=[time.end=1000]";   // sync points every 10 ms
constexpr const char* kWaiter = "--wait-for-time";  // see node_main.cpp

/// A node that ends when ros::Time::now() is valid.
int wait_for_time(int argc, char** argv) {
  ros::init(argc, argv, "waiter");
  const ros::NodeHandle node;
  return ros::Time::waitForValid(ros::WallDuration(10.0)) ? 0 : 1;
}

void use_sim_time(bool use) { ros::param::set("/use_sim_time", use); }

void pause(const SimulatorProcess& simulator, bool paused) {
  std_srvs::SetBool call;
  call.request.data = paused ? 1 : 0;
  ASSERT_TRUE(simulator.call("pause", call)) << simulator.log();
  EXPECT_TRUE(call.response.success) << call.response.message;
}

std_srvs::Trigger::Response reset(const SimulatorProcess& simulator) {
  std_srvs::Trigger call;
  EXPECT_TRUE(simulator.call("reset", call)) << simulator.log();
  EXPECT_TRUE(call.response.success) << call.response.message;
  return call.response;
}

bool publishes_clock(const SimulatorProcess& simulator) {
  XmlRpc::XmlRpcValue request, response, payload;
  request[0] = ros::this_node::getName();
  EXPECT_TRUE(ros::master::execute("getSystemState", request, response, payload, false));
  for (int i = 0; i < payload[0].size(); ++i) {
    XmlRpc::XmlRpcValue& nodes = payload[0][i][1];
    for (int k = 0; static_cast<std::string>(payload[0][i][0]) == "/clock" && k < nodes.size(); ++k) {
      if (static_cast<std::string>(nodes[k]) == simulator.name("simulator")) return true;
    }
  }
  return false;
}

TEST(Pacing, RealTimeNeverRunsAheadAndKeepsItsFactor) {
  use_sim_time(false);
  SimulatorProcess simulator({kPress, kLong, "threads:=1", "real_time_factor:=0.5"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<SolverState> states(simulator.name("solver_state"));
  ASSERT_TRUE(states.hears(2));
  const double first = states.heard().back().time;
  const auto from = std::chrono::steady_clock::now();
  ASSERT_TRUE(eventually([&] { return states.heard().back().time >= first + 1.0; })) << simulator.log();
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
  // 1 s of simulated time at half the wall's pace takes 2 s. It may take less by the age of the first message and by
  // the 100 ms of delay that are caught up with, and more on a busy machine.
  EXPECT_GE(wall, 1.85);
  EXPECT_LE(wall, 3.0);
}

TEST(Pacing, OverrunsAreCountedAndShown) {
  use_sim_time(true);
  SimulatorProcess simulator({kPress, kLong, "threads:=1", "real_time_factor:=1e6"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  Ear<SolverState> states(simulator.name("solver_state"));
  ASSERT_TRUE(states.hears(20));
  // No machine is that fast: each period is late, and the next state shows it.
  const SolverState last = states.heard().back();
  const auto periods = static_cast<std::uint64_t>(std::llround(last.time / 0.01));
  EXPECT_EQ(last.overruns, periods - 1);
  EXPECT_TRUE(diagnosed(diagnostics, simulator, "slower than asked"));
}

// A budget of wall time that ten sweeps do not fit in ends no run: it is told of, with the numbers, and in each state.
TEST(Pacing, ABudgetThatIsTooLittleIsToldOf) {
  use_sim_time(true);
  SimulatorProcess simulator({"scene:=" + data_file("implicit_blade.yaml"),
                              "set:=[time.budget=1 us, time.end=1000, "
                              "rigid_bodies.blade.motion.velocity=[0.3 * cos(20 * t), 0]]",
                              "threads:=1"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  Ear<SolverState> states(simulator.name("solver_state"));
  ASSERT_TRUE(states.hears(50));
  const SolverState last = states.heard().back();
  const auto number = [&](const std::string& name) {
    const auto own = [&](const NamedValue& value) { return value.name == name; };
    const auto found = std::find_if(last.values.begin(), last.values.end(), own);
    return found == last.values.end() ? -1.0 : found->value.at(0);
  };
  EXPECT_EQ(number("sweeps"), 10.0);
  EXPECT_GT(number("sweeps_cut"), 0.0);
  EXPECT_GE(number("sweep_error"), 0.0);
  std::size_t cut = 0;
  for (const SolverState& state : states.heard()) {
    ASSERT_EQ(state.cut_steps.size(), state.cut_sweeps.size());
    for (std::size_t i = 0; i < state.cut_steps.size(); ++i, ++cut) {
      EXPECT_EQ(state.cut_steps[i], state.steps);  // one a period
      EXPECT_EQ(state.cut_sweeps[i], 10U);
    }
  }
  EXPECT_GT(cut, 0U);
  EXPECT_TRUE(diagnosed(diagnostics, simulator, "time.budget: 0.001 ms is too little: with 10 sweeps in a step"));
  EXPECT_NE(simulator.log().find("time.budget: 0.001 ms is too little"), std::string::npos) << simulator.log();
}

// Forecast of a run's pace at its start: before it runs, by timing a copy of it in real time alone, which is then kept
// for all.
TEST(Pacing, TheStartForecastsAndWarns) {
  use_sim_time(false);
  const TemporaryFolder folder;
  setenv("XDG_CACHE_HOME", folder.file("cache").c_str(), 1);
  const auto said = [](const SimulatorProcess& simulator, const std::string& text) {
    return eventually([&] { return simulator.log().find(text) != std::string::npos; });
  };
  const std::vector<std::string> step = {kPress, "set:=[time.end=10, time.step=1e-6]", "threads:=1"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), step.begin(), step.end());
    return more;
  };
  {
    SimulatorProcess simulator(with({"pacing:=lockstep"}));
    ASSERT_TRUE(simulator.ready()) << simulator.log();
    EXPECT_TRUE(said(simulator, "160 particles, lockstep, 1 thread, in " + simulator.name_space() +
                                    "; waits for the service " + simulator.name("step")))
        << simulator.log();
    EXPECT_EQ(simulator.log().find("expected on"), std::string::npos) << "nothing is timed: " << simulator.log();
  }
  {
    // A million steps a second, of 160 particles, are beyond any machine.
    SimulatorProcess simulator(with({}));
    ASSERT_TRUE(simulator.ready()) << simulator.log();
    for (const char* text : {"real time, 1 thread, in ", "runs to 10 s",
                             "real time is not in reach: ", "of real time expected on 1 thread; 10 s will take ",
                             "method.precision=single", "--explain"})
      EXPECT_TRUE(said(simulator, text)) << text << "\n" << simulator.log();
  }
  SimulatorProcess simulator(with({"pacing:=free"}));
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  EXPECT_TRUE(said(simulator, "of real time expected on 1 thread")) << "as it was kept: " << simulator.log();
  EXPECT_TRUE(said(simulator, "the run goes at ")) << simulator.log();
  unsetenv("XDG_CACHE_HOME");
}

TEST(Pacing, TheForecastLeavesTheBitsOfARun) {
  use_sim_time(false);
  const TemporaryFolder folder;
  setenv("XDG_CACHE_HOME", folder.file("cache").c_str(), 1);
  std::vector<std::string> hashes;
  for (const char* pacing : {"free", "real_time"}) {  // the second is timed, the first is not
    const std::string bag = folder.file(pacing + std::string(".bag"));
    SimulatorProcess simulator({kPress, "threads:=1", "record:=" + bag, std::string("pacing:=") + pacing});
    EXPECT_EQ(simulator.wait(), 0) << simulator.log();
    const bool forecast = simulator.log().find("of real time expected") != std::string::npos;
    EXPECT_EQ(forecast, std::string(pacing) == "real_time") << simulator.log();
    hashes.push_back(hash_in(bag));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  unsetenv("XDG_CACHE_HOME");
}

TEST(Pacing, TheClockIsThrottledInSimulatedTime) {
  use_sim_time(true);
  SimulatorProcess simulator({kPress, kLong, "pacing:=lockstep", "threads:=1", "clock_rate:=20.0"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  ASSERT_TRUE(publishes_clock(simulator));
  Ear<rosgraph_msgs::Clock> clock("/clock");
  ASSERT_TRUE(clock.hears(1));
  Step::Request request;
  request.duration = 0.33;
  ASSERT_TRUE(simulator.step(request).success);
  ASSERT_TRUE(clock.hears(7));
  // Time zero, which has the stamp of one nanosecond, and every 50 ms up to 0.30 s.
  std::vector<std::uint64_t> expected{1};
  for (std::uint64_t k = 1; k <= 6; ++k) expected.push_back(k * 50'000'000);
  std::vector<std::uint64_t> times;
  for (const rosgraph_msgs::Clock& message : clock.heard()) times.push_back(message.clock.toNSec());
  EXPECT_EQ(times, expected);
}

TEST(Pacing, TheClockIsLeftToAnotherOwner) {
  use_sim_time(true);
  SimulatorProcess simulator({kPress, kLong, "pacing:=lockstep", "threads:=1", "publish_clock:=false"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  EXPECT_FALSE(publishes_clock(simulator));
  const ros::Publisher owner = ros::NodeHandle().advertise<rosgraph_msgs::Clock>("/clock", 1, true);
  rosgraph_msgs::Clock message;
  message.clock = ros::Time(100.0);
  owner.publish(message);
  EXPECT_EQ(simulator.step(3).stamp, ros::Time(0, 30'000'000));  // stamps are still those of the solver
}

TEST(Pacing, WithoutSimulatedTimeThereIsNoClock) {
  use_sim_time(false);
  const ros::Time before = ros::Time(ros::WallTime::now().toSec());
  SimulatorProcess simulator({kPress, kLong, "pacing:=lockstep", "threads:=1"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  EXPECT_FALSE(publishes_clock(simulator));
  const ros::Time first = simulator.step(1).stamp;
  EXPECT_GT(first, before);
  EXPECT_EQ(simulator.step(2).stamp - first, ros::Duration(0, 20'000'000));
}

/// A robot's hand that moves along x at 0.05 m/s, by the wall clock.
class Robot {
 public:
  void tell() {
    tf2_msgs::TFMessage message;
    message.transforms.resize(1);
    geometry_msgs::TransformStamped& transform = message.transforms[0];
    const ros::WallTime now = ros::WallTime::now();
    transform.header.stamp = ros::Time(now.sec, now.nsec);
    transform.header.frame_id = "world";
    transform.child_frame_id = "hand";
    place = 0.05 * (now - start_).toSec();
    transform.transform.translation.x = place;
    transform.transform.translation.z = 0.08;
    transform.transform.rotation.w = 1.0;
    tf_.publish(message);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  double place = 0.0;  ///< place now [m]

 private:
  ros::Publisher tf_ = ros::NodeHandle().advertise<tf2_msgs::TFMessage>("/tf", 100);
  const ros::WallTime start_ = ros::WallTime::now();
};

// A run at a fifth of real time is 0.8 s behind after a second, and its tool as much behind the robot.
TEST(Pacing, ARunBehindTheRobotsClockSaysSoInTheFirstSecond) {
  use_sim_time(false);
  SimulatorProcess simulator(
      {"scene:=" + data_file("drive.yaml"), "set:=[time.end=100]", "threads:=1", "real_time_factor:=0.2"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  const auto from = std::chrono::steady_clock::now();
  Robot robot;
  ASSERT_TRUE(eventually([&] {
    robot.tell();
    return simulator.log().find("behind the wall clock") != std::string::npos;
  })) << simulator.log();
  // And a second for this test's own start, while the run goes on already.
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count(), 2.0);
  for (const char* text :
       {"of the clock's pace", "the tf frame 'hand'", "/use_sim_time", "_tf_time:=latest", "grid.cell"}) {
    EXPECT_NE(simulator.log().find(text), std::string::npos) << text << "\n" << simulator.log();
  }
}

TEST(Pacing, TheNewestTransformIsFollowedOnRequestAndMarked) {
  use_sim_time(false);
  SimulatorProcess simulator({"scene:=" + data_file("drive.yaml"), "set:=[time.end=100]", "threads:=1",
                              "real_time_factor:=0.2", "tf_time:=latest"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<BodyStates> bodies(simulator.name("bodies"));
  Ear<mpm_ros::Command> commands(simulator.name("commands"));
  ASSERT_TRUE(bodies.connected() && commands.connected());
  Robot robot;
  double behind = 1.0;
  for (int i = 0; i < 300; ++i) {
    robot.tell();
    if (const auto heard = bodies.heard(); !heard.empty())
      behind = robot.place - heard.back().bodies.at(1).pose.position.x;
  }
  // After three seconds by stamps it would be 2.4 s behind, 0.12 m; here by a command period and messages under way.
  EXPECT_LT(std::abs(behind), 0.03) << simulator.log();
  ASSERT_TRUE(commands.hears(1));
  for (const mpm_ros::Command& command : commands.heard()) {
    EXPECT_TRUE(command.stamp_ignored);
    EXPECT_GT(command.requested.toSec(), command.header.stamp.toSec());  // the stamp that was not used is ahead
  }
  EXPECT_EQ(simulator.log().find("behind the wall clock"), std::string::npos) << simulator.log();
}

TEST(Pacing, StampedCommandsByTheWallClockSayAndDoTheSame) {
  use_sim_time(false);
  for (const bool latest : {false, true}) {
    SimulatorProcess simulator({kPress, kLong, "threads:=1", "real_time_factor:=0.2",
                                std::string("command_time:=") + (latest ? "latest" : "stamp")});
    ASSERT_TRUE(simulator.ready()) << simulator.log();
    Ear<mpm_ros::Command> commands(simulator.name("commands"));
    ros::Publisher publisher =
        ros::NodeHandle().advertise<geometry_msgs::TwistStamped>(simulator.name("bodies/rod/cmd_vel_stamped"), 10);
    ASSERT_TRUE(commands.connected() && eventually([&] { return publisher.getNumSubscribers() > 0; }));
    const auto said = [&] { return simulator.log().find("the commands for 'rod' are stamped") != std::string::npos; };
    for (int i = 0; i < 100 && !said(); ++i) {
      geometry_msgs::TwistStamped command;
      const ros::WallTime now = ros::WallTime::now();
      command.header.stamp = ros::Time(now.sec, now.nsec);
      publisher.publish(command);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_EQ(said(), !latest) << simulator.log();
    if (!latest) continue;
    ASSERT_TRUE(commands.hears(50)) << simulator.log();
    EXPECT_TRUE(commands.heard().back().stamp_ignored);
  }
}

TEST(Pacing, AnotherOwnersClockMayJump) {
  use_sim_time(true);
  SimulatorProcess simulator({kPress, kLong, "pacing:=lockstep", "threads:=1", "publish_clock:=false"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  ros::NodeHandle node;
  ros::Publisher clock = node.advertise<rosgraph_msgs::Clock>("/clock", 10);
  ros::Publisher transforms = node.advertise<tf2_msgs::TFMessage>("/tf", 10);
  ASSERT_TRUE(eventually([&] { return clock.getNumSubscribers() > 0 && transforms.getNumSubscribers() > 0; }));
  // By more than the 68 years of a ros::Duration, and to the end of what a ros::Time holds.
  for (const double now : {4e9, 1.0, 4294967295.0, 2.0}) {
    rosgraph_msgs::Clock message;
    message.clock = ros::Time(now);
    clock.publish(message);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    tf2_msgs::TFMessage tf;
    tf.transforms.resize(1);
    tf.transforms[0].header.stamp = message.clock;
    tf.transforms[0].header.frame_id = "world";
    tf.transforms[0].child_frame_id = "arm";
    tf.transforms[0].transform.rotation.w = 1.0;
    transforms.publish(tf);
    std::this_thread::sleep_for(std::chrono::milliseconds(1200));  // diagnostics come each second
  }
  EXPECT_TRUE(simulator.step(1).success) << simulator.log();
  simulator.signal(SIGINT);
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();
}

TEST(Pacing, StartingPausedHangsNobody) {
  use_sim_time(true);
  SimulatorProcess simulator({kPress, kLong, "threads:=1", "start_paused:=true"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  // A node that starts later receives the time.
  ProgramProcess waiter("node_tests", {kWaiter});
  EXPECT_EQ(waiter.wait(20.0), 0) << waiter.log();
  // Services answer.
  EXPECT_TRUE(simulator.step(1).success);
  reset(simulator);
  Ear<SolverState> states(simulator.name("solver_state"));
  ASSERT_TRUE(states.hears(1));
  EXPECT_EQ(states.heard().back().time, 0.0);
  pause(simulator, false);
  EXPECT_TRUE(eventually([&] { return states.heard().back().time > 0.05; }));
  // The same in the middle of a run.
  pause(simulator, true);
  ProgramProcess later("node_tests", {kWaiter});
  EXPECT_EQ(later.wait(20.0), 0) << later.log();
}

/// Times on /clock over a run, a reset and the same run again.
std::vector<std::uint64_t> clock_over_reset(const std::string& reset_time, const std::string& bag) {
  use_sim_time(true);
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1", "reset_time:=" + reset_time, "record:=" + bag});
  EXPECT_TRUE(simulator.ready()) << simulator.log();
  Ear<rosgraph_msgs::Clock> clock("/clock");
  Ear<RunInfo> info(simulator.name("run_info"));
  EXPECT_TRUE(clock.hears(1) && info.hears(1));
  EXPECT_TRUE(simulator.step(5, {velocity("plate", -0.1)}).success);
  reset(simulator);
  EXPECT_TRUE(info.hears(2));
  const Step::Response again = simulator.step(5, {velocity("plate", -0.1)});
  EXPECT_TRUE(again.success) << again.message;
  EXPECT_NEAR(again.time, 0.01, 1e-12);
  EXPECT_EQ(again.stamp, info.heard()[1].start + ros::Duration(0, 10'000'000));
  EXPECT_TRUE(clock.hears(12));
  Ear<SolverState> states(simulator.name("solver_state"));
  EXPECT_TRUE(states.hears(1));
  EXPECT_EQ(states.heard().back().commands_applied, 1U);  // counted from the start of this run
  EXPECT_EQ(states.heard().back().steps, last_state_in(bag).steps);
  simulator.signal(SIGINT);
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  std::vector<std::uint64_t> times;
  for (const rosgraph_msgs::Clock& message : clock.heard()) times.push_back(message.clock.toNSec());
  return times;
}

TEST(Pacing, ResetGoesOnWithLaterStamps) {
  const TemporaryFolder folder;
  // Sync points are 2 ms apart; the start of the second run is stamped one period after the end of the first.
  std::vector<std::uint64_t> expected{1};
  for (std::uint64_t k = 1; k <= 11; ++k) expected.push_back(k * 2'000'000);
  EXPECT_EQ(clock_over_reset("continue", folder.file("run.bag")), expected);
  EXPECT_EQ(hash_in(folder.file("run.bag")), hash_in(folder.file("run_2.bag")));
}

TEST(Pacing, ResetSetsTimeBackToZeroOnRequest) {
  const TemporaryFolder folder;
  std::vector<std::uint64_t> expected;
  for (int run = 0; run < 2; ++run) {
    expected.push_back(1);
    for (std::uint64_t k = 1; k <= 5; ++k) expected.push_back(k * 2'000'000);
  }
  EXPECT_EQ(clock_over_reset("zero", folder.file("run.bag")), expected);
  EXPECT_EQ(hash_in(folder.file("run.bag")), hash_in(folder.file("run_2.bag")));
}

TEST(Pacing, TheWallsClockCannotBeSetBack) {
  use_sim_time(false);
  SimulatorProcess simulator({kPress, "reset_time:=zero"});
  EXPECT_EQ(simulator.wait(), 2) << simulator.log();
  ASSERT_EQ(simulator.fatal_lines().size(), 1U) << simulator.log();
  EXPECT_NE(simulator.fatal_lines()[0].find("~reset_time is zero"), std::string::npos);
}

}  // namespace pacing_node_test
}  // namespace mpm_ros::test
