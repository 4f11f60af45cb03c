// The contract of lockstep (doc/loop.md): the same commands give the same bits, whatever the load, the number of
// threads and the order in which messages arrive; and the behaviour when a controller dies.
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistStamped.h>
#include <mpm_ros/BodyStates.h>
#include <mpm_ros/Command.h>
#include <mpm_ros/SolverState.h>

#include <atomic>
#include <cmath>
#include <cstring>

#include "simulator_process.hpp"
#include "test_files.hpp"

namespace mpm_ros::test {
namespace determinism_node_test {

const std::string kPress = "scene:=" + data_file("press.yaml");
constexpr const char* kSender = "--sender";  // see node_main.cpp

/// A node that sends one command; words: topic, vz, stamp [ns].
int send(int argc, char** argv, char** words) {
  ros::init(argc, argv, "sender");
  ros::NodeHandle node;
  geometry_msgs::TwistStamped twist;
  twist.header.frame_id = "world";
  twist.header.stamp.fromNSec(std::stoull(words[2]));
  twist.twist.linear.z = std::stod(words[1]);
  const ros::Publisher publisher = node.advertise<geometry_msgs::TwistStamped>(words[0], 1);
  while (ros::ok() && publisher.getNumSubscribers() == 0) ros::WallDuration(0.01).sleep();
  publisher.publish(twist);
  ros::spin();
  return 0;
}

/// More threads than there are cores, which compute all the time.
class Load {
 public:
  explicit Load(bool on) {
    for (unsigned i = 0; on && i < 2 * std::thread::hardware_concurrency(); ++i) {
      threads_.emplace_back([this] {
        while (!stop_) ++work_;
      });
    }
  }
  ~Load() {
    stop_ = true;
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  std::atomic<bool> stop_{false};
  std::atomic<unsigned> work_{0};
  std::vector<std::thread> threads_;
};

/// Number of messages received on command topics, from the answer to a step request that is refused and changes
/// nothing.
std::uint64_t received(const SimulatorProcess& simulator) {
  Step::Request request;
  request.duration = -1.0;
  return simulator.step(request).received;
}

/// A run with commands in requests and by two nodes that send different ones for the same time; returns the hash of its
/// end.
std::string driven_run(const std::string& bag, int threads, bool load, bool b_first) {
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=" + std::to_string(threads), "record:=" + bag});
  const Load busy(load);
  EXPECT_TRUE(simulator.ready()) << simulator.log();
  EXPECT_TRUE(simulator.step(10, {velocity("plate", -0.1), velocity("rod", -0.05)}).success);
  std::vector<std::unique_ptr<ProgramProcess>> senders;
  for (const char* name : {b_first ? "b" : "a", b_first ? "a" : "b"}) {
    senders.push_back(std::make_unique<ProgramProcess>(
        "node_tests",
        std::vector<std::string>{kSender, simulator.name("bodies/plate/cmd_vel_stamped"),
                                 *name == 'a' ? "-0.02" : "-0.05", "60000000", std::string("__name:=") + name},
        "/senders"));
    EXPECT_TRUE(eventually([&] { return received(simulator) == senders.size(); })) << simulator.log();
  }
  Step::Request further;
  further.duration = 0.08;
  further.after_received = 2;
  const Step::Response between = simulator.step(further);
  EXPECT_TRUE(between.success) << between.message;
  EXPECT_EQ(between.bodies.bodies[0].twist.linear.z, -0.05);  // /senders/b comes after /senders/a
  mpm_ros::Command pose;
  pose.body = "rod";
  pose.kind = mpm_ros::Command::POSE;
  pose.pose.position.x = 0.17;
  pose.pose.position.z = 0.08;
  pose.pose.orientation.w = 1.0;
  EXPECT_TRUE(simulator.step(10000, {pose}).success);
  simulator.signal(SIGINT);
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  return hash_in(bag);
}

TEST(Determinism, LoadThreadsAndArrivalDoNotShow) {
  const TemporaryFolder folder;
  const std::string hash = driven_run(folder.file("one.bag"), 1, false, false);
  ASSERT_EQ(hash.size(), 16U);
  EXPECT_EQ(driven_run(folder.file("two.bag"), 2, true, true), hash);

  // The run under load again from its bag, as fast as possible.
  SimulatorProcess replay({kPress, "pacing:=free", "threads:=1", "commands:=" + folder.file("two.bag"),
                           "record:=" + folder.file("replay.bag")});
  EXPECT_EQ(replay.wait(), 0) << replay.log();
  EXPECT_EQ(hash_in(folder.file("replay.bag")), hash);
}

TEST(Determinism, AStepWaitsForMessagesUnderWayAndSaysWhenTheyStayAway) {
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  ros::Publisher publisher = ros::NodeHandle().advertise<geometry_msgs::Twist>(simulator.name("bodies/rod/cmd_vel"), 1);
  ASSERT_TRUE(eventually([&] { return publisher.getNumSubscribers() > 0; }));
  geometry_msgs::Twist up;
  up.linear.z = 0.01;
  Step::Request request;
  request.count = 1;
  for (std::uint64_t n = 1; n <= 50; ++n) {
    up.linear.z = 0.001 * static_cast<double>(n);
    publisher.publish(up);
    request.after_received = n;
    const Step::Response response = simulator.step(request);
    ASSERT_TRUE(response.success) << response.message;
    EXPECT_EQ(response.received, n);
    EXPECT_EQ(response.bodies.bodies[1].twist.linear.z, up.linear.z);
  }
  const double before = simulator.step(1).time;
  request.after_received = 51;
  const Step::Response response = simulator.step(request);
  EXPECT_FALSE(response.success);
  EXPECT_NE(response.message.find("for 51 messages on command topics; 50 have come"), std::string::npos)
      << response.message;
  EXPECT_NEAR(simulator.step(1).time, before + 0.002, 1e-12);  // the refused step took no time
}

TEST(Determinism, WhatComesDuringAStepWaitsForItsEnd) {
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1", "set:=[time.end=1000]"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<SolverState> states(simulator.name("solver_state"));
  Ear<mpm_ros::Command> commands(simulator.name("commands"));
  ros::Publisher publisher = ros::NodeHandle().advertise<geometry_msgs::Twist>(simulator.name("bodies/rod/cmd_vel"), 1);
  ASSERT_TRUE(commands.connected() && eventually([&] { return publisher.getNumSubscribers() > 0; }));
  std::atomic<bool> done{false};
  Step::Response response;
  std::thread caller([&] {
    Step::Request request;
    request.duration = 10.0;
    response = simulator.step(request);
    done = true;
  });
  EXPECT_TRUE(eventually([&] { return !states.heard().empty() && states.heard().back().time > 0.05; }));
  geometry_msgs::Twist up;
  up.linear.z = 1e-4;
  publisher.publish(up);
  EXPECT_FALSE(done);
  caller.join();
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_EQ(response.bodies.bodies[1].drive, BodyState::FUNCTIONS);
  Step::Request next;
  next.count = 1;
  next.after_received = 1;
  EXPECT_EQ(simulator.step(next).bodies.bodies[1].drive, BodyState::VELOCITY);
  ASSERT_TRUE(commands.hears(1));
  EXPECT_EQ(commands.heard()[0].effect_ns, 10'000'000'000);
}

TEST(Determinism, ACommandThatTheBodyRefusesKeepsTimeWhereItIs) {
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  const Step::Response refused = simulator.step(5, {velocity("plate", 1e9)});
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("more than the domain's diagonal"), std::string::npos) << refused.message;
  EXPECT_EQ(refused.time, 0.0);
  const Step::Response next = simulator.step(5);
  EXPECT_TRUE(next.success) << next.message;
  EXPECT_EQ(next.bodies.bodies[0].drive, BodyState::FUNCTIONS);
}

TEST(Determinism, AStepOfNoSensibleLengthIsRefused) {
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Step::Request request;
  for (const double duration : {-1e-9, 1e300, std::nan("")}) {
    request.duration = duration;
    const Step::Response response = simulator.step(request);
    EXPECT_FALSE(response.success) << duration;
    EXPECT_NE(response.message.find("it must be at least 0"), std::string::npos) << response.message;
    EXPECT_EQ(response.time, 0.0);
  }
}

TEST(Determinism, AKilledControllersToolStopsInTheTimeout) {
  SimulatorProcess simulator(
      {kPress, "pacing:=real_time", "threads:=1", "set:=[time.end=1000]", "command_timeout:=0.1", "on_timeout:=stop"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<BodyStates> bodies(simulator.name("bodies"));
  Ear<mpm_ros::Command> commands(simulator.name("commands"));
  ASSERT_TRUE(bodies.connected() && commands.connected());
  XmlRpc::XmlRpcValue phase;
  phase["name"] = "lift";
  phase["begin"] = 0.0;
  phase["end"] = 1000.0;
  phase["ramp"] = 0.01;
  phase["linear"][0] = 0.0;
  phase["linear"][1] = 0.0;
  phase["linear"][2] = 0.001;
  XmlRpc::XmlRpcValue phases;
  phases[0] = phase;
  ros::param::set(simulator.name("blade_driver/phases"), phases);
  ProgramProcess driver("blade_driver", {"_topic:=bodies/rod/cmd_vel_stamped"}, simulator.name_space());
  ASSERT_TRUE(commands.hears(10)) << driver.log() << simulator.log();
  driver.signal(SIGKILL);

  const auto stopped = [&] {
    const std::vector<mpm_ros::Command> heard = commands.heard();
    return heard.back().twist.linear.z == 0.0;
  };
  ASSERT_TRUE(eventually(stopped)) << simulator.log();
  const std::vector<mpm_ros::Command> heard = commands.heard();
  const std::int64_t last = heard[heard.size() - 2].effect_ns, stop = heard.back().effect_ns;
  EXPECT_GT(heard[heard.size() - 2].twist.linear.z, 0.0);
  EXPECT_EQ(stop - last, 100'000'000);  // both are sync points, 10 ms apart
  const auto at_rest = [&] {
    const BodyStates state = bodies.heard().back();
    return state.header.stamp.toNSec() > static_cast<std::uint64_t>(stop) && state.bodies[1].twist.linear.z == 0.0;
  };
  EXPECT_TRUE(eventually(at_rest));
  for (const BodyStates& state : bodies.heard()) {
    const auto time = static_cast<std::int64_t>(state.header.stamp.toNSec());
    const double speed = state.bodies[1].twist.linear.z;
    if (time > last && time < stop) {
      EXPECT_GT(speed, 0.0) << "stopped early, at " << time << " ns";
    } else if (time > stop) {
      EXPECT_EQ(speed, 0.0) << "at " << time << " ns";
    }
  }
}

TEST(Determinism, AKilledControllerStopsTheLockstepsTime) {
  SimulatorProcess simulator({"scene:=foam_probe", "pacing:=lockstep", "threads:=1"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<SolverState> states(simulator.name("solver_state"));
  ProgramProcess controller("force_controller", {}, simulator.name_space());
  ASSERT_TRUE(eventually([&] { return !states.heard().empty() && states.heard().back().time > 0.2; }))
      << controller.log() << simulator.log();
  controller.signal(SIGKILL);
  ASSERT_EQ(controller.wait(), -2);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // the present step ends
  const double time = states.heard().back().time;
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_EQ(states.heard().back().time, time);
  // Another controller continues from there.
  const Step::Response response = simulator.step(1);
  EXPECT_TRUE(response.success) << response.message;
  EXPECT_NEAR(response.time, time + 0.002, 1e-9);
}

}  // namespace determinism_node_test
}  // namespace mpm_ros::test
