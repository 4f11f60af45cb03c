// The node in lockstep, in simulated time: topics and types, commands and their effects, services, replay.
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <mpm_ros/BodyStates.h>
#include <mpm_ros/Command.h>
#include <mpm_ros/ContactForces.h>
#include <mpm_ros/RunInfo.h>
#include <mpm_ros/SolverState.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include "simulator_process.hpp"
#include "test_files.hpp"

namespace mpm_ros::test {
namespace lockstep_node_test {

const std::string kPress = "scene:=" + data_file("press.yaml");
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Waits for the simulator's subscriber and publishes once.
template <typename Message>
void say(const std::string& topic, const Message& message) {
  static std::map<std::string, ros::Publisher> publishers;
  ros::Publisher& publisher = publishers[topic];
  if (!publisher) publisher = ros::NodeHandle().advertise<Message>(topic, 10);
  ASSERT_TRUE(eventually([&] { return publisher.getNumSubscribers() > 0; })) << topic;
  publisher.publish(message);
}

/// Steps until the body moves as commanded, because a message on a topic arrives some time after it was sent.
bool steps_until(const SimulatorProcess& simulator, const std::function<bool(const Step::Response&)>& so) {
  return eventually([&] { return so(simulator.step(1)); });
}

TEST(Lockstep, TopicsAndServicesHaveTheirTypes) {
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  // The master's table of types includes subscribed topics.
  std::map<std::string, std::string> types;
  XmlRpc::XmlRpcValue request, response, payload;
  request[0] = ros::this_node::getName();
  ASSERT_TRUE(ros::master::execute("getTopicTypes", request, response, payload, false));
  for (int i = 0; i < payload.size(); ++i) types[payload[i][0]] = static_cast<std::string>(payload[i][1]);
  const std::map<std::string, std::string> expected{
      {simulator.name("bodies/plate/cmd_vel"), "geometry_msgs/Twist"},
      {simulator.name("bodies/plate/cmd_vel_stamped"), "geometry_msgs/TwistStamped"},
      {simulator.name("bodies/plate/cmd_pose"), "geometry_msgs/PoseStamped"},
      {simulator.name("bodies/rod/cmd_vel"), "geometry_msgs/Twist"},
      {simulator.name("bodies/plate/wrench"), "geometry_msgs/WrenchStamped"},
      {simulator.name("particles"), "sensor_msgs/PointCloud2"},
      {simulator.name("contact_forces"), "mpm_ros/ContactForces"},
      {simulator.name("bodies"), "mpm_ros/BodyStates"},
      {simulator.name("commands"), "mpm_ros/Command"},
      {simulator.name("solver_state"), "mpm_ros/SolverState"},
      {simulator.name("run_info"), "mpm_ros/RunInfo"},
      {simulator.name("markers"), "visualization_msgs/MarkerArray"},
      {simulator.name("force_markers"), "visualization_msgs/MarkerArray"},
      {"/clock", "rosgraph_msgs/Clock"},
      {"/tf", "tf2_msgs/TFMessage"},
      {"/diagnostics", "diagnostic_msgs/DiagnosticArray"}};
  for (const auto& [topic, type] : expected) EXPECT_EQ(types[topic], type) << topic;

  // A call with the wrong type fails in the handshake, so a call that succeeds shows the type.
  std_srvs::SetBool set;
  EXPECT_TRUE(simulator.call("pause", set));
  std_srvs::Trigger trigger;
  EXPECT_TRUE(simulator.call("reset", trigger));
  Step step;
  EXPECT_TRUE(simulator.call("step", step));
}

TEST(Lockstep, CommandMovesTheBodyAndTheBodyFeelsTheMaterial) {
  const TemporaryFolder folder;
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1", "record:=" + folder.file("run.bag")});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<ContactForces> forces(simulator.name("contact_forces"));
  Ear<geometry_msgs::WrenchStamped> wrench(simulator.name("bodies/plate/wrench"));
  Ear<sensor_msgs::PointCloud2> particles(simulator.name("particles"));
  Ear<mpm_ros::Command> commands(simulator.name("commands"));
  ASSERT_TRUE(forces.connected() && wrench.connected() && particles.connected() && commands.connected());

  Step::Request request;
  request.duration = 0.1;
  request.commands.push_back(velocity("plate", -0.1));
  const Step::Response response = simulator.step(request);
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_NEAR(response.time, 0.1, 1e-9);
  EXPECT_EQ(response.stamp, ros::Time(0, 100'000'000));
  // 0.065 m - 0.1 m/s x 0.1 s, with round-off of some thousand steps.
  ASSERT_EQ(response.bodies.bodies.size(), 2U);
  EXPECT_EQ(response.bodies.bodies[0].name, "plate");
  EXPECT_NEAR(response.bodies.bodies[0].pose.position.z, 0.055, 1e-12);
  EXPECT_EQ(response.bodies.bodies[0].drive, BodyState::VELOCITY);
  EXPECT_EQ(response.bodies.bodies[1].drive, BodyState::FUNCTIONS);
  // The plate has moved 5 mm into the strip, which pushes it up; the rod touches nothing.
  EXPECT_GT(response.contact_forces.bodies[0].wrench.force.z, 0.0);
  EXPECT_NEAR(response.contact_forces.bodies[0].interval, 0.1, 1e-9);
  EXPECT_EQ(response.contact_forces.bodies[1].wrench.force.z, 0.0);

  // Everything was published before the answer; the messages only have to arrive.
  const Ear<SolverState> state(simulator.name("solver_state"));
  ASSERT_TRUE(state.hears(1));
  ASSERT_TRUE(commands.hears(1));
  EXPECT_EQ(commands.heard()[0].body, "plate");
  EXPECT_EQ(commands.heard()[0].effect_ns, 0);
  EXPECT_EQ(commands.heard()[0].twist.linear.z, -0.1);
  ASSERT_TRUE(
      eventually([&] { return !forces.heard().empty() && forces.heard().back().header.stamp == response.stamp; }));
  ASSERT_TRUE(
      eventually([&] { return !wrench.heard().empty() && wrench.heard().back().header.stamp == response.stamp; }));
  EXPECT_EQ(wrench.heard().back().header.frame_id, "plate");
  // The plate is not rotated, so its axes are those of the world.
  EXPECT_EQ(wrench.heard().back().wrench.force.z, forces.heard().back().bodies[0].wrench.force.z);
  // The mean over the step is the sum of the parts, up to round-off.
  double impulse = 0.0;
  for (const ContactForces& message : forces.heard()) {
    impulse += message.bodies[0].wrench.force.z * message.bodies[0].interval;
  }
  EXPECT_NEAR(impulse, response.contact_forces.bodies[0].wrench.force.z * 0.1, 1e-9 * impulse);
  ASSERT_TRUE(particles.hears(5));
  EXPECT_EQ(particles.heard().back().width, 160U);  // 10 x 4 cells, four in each

  simulator.signal(SIGINT);
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  rosbag::Bag bag(folder.file("run.bag"));
  rosbag::View recorded(bag, rosbag::TopicQuery(simulator.name("contact_forces")));
  EXPECT_EQ(recorded.size(), forces.heard().size() + 1);  // and the one at the start, before there was a subscriber
  rosbag::View applied(bag, rosbag::TopicQuery(simulator.name("commands")));
  EXPECT_EQ(applied.size(), 1U);
  EXPECT_EQ(recorded.getBeginTime(), ros::TIME_MIN);
}

/// Drives a whole run by commands on topics and in steps; returns the hash of its end.
std::string driven_run(const std::string& bag, int threads) {
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=" + std::to_string(threads), "record:=" + bag});
  EXPECT_TRUE(simulator.ready()) << simulator.log();
  EXPECT_TRUE(simulator.step(10, {velocity("plate", -0.1), velocity("rod", -0.05)}).success);
  // Its stamp is well ahead of the simulation, which waits: it takes effect at its stamp, whenever it arrives.
  geometry_msgs::TwistStamped slower;
  slower.header.frame_id = "world";
  slower.header.stamp = ros::Time(0, 120'000'000);
  slower.twist.linear.z = -0.02;
  slower.twist.angular.y = 0.5;
  Ear<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  say(simulator.name("bodies/plate/cmd_vel_stamped"), slower);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  Step::Request further;
  further.duration = 0.12;
  EXPECT_TRUE(simulator.step(further).success);
  mpm_ros::Command pose;
  pose.body = "rod";
  pose.kind = mpm_ros::Command::POSE;
  pose.pose.position.x = 0.17;
  pose.pose.position.z = 0.08;
  pose.pose.orientation.w = 1.0;
  const Step::Response last = simulator.step(10000, {pose});
  EXPECT_TRUE(last.success) << last.message;
  EXPECT_NEAR(last.time, 0.2, 1e-9);
  simulator.signal(SIGTERM);
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  return hash_in(bag);
}

TEST(Lockstep, ThreadsAndReplayGiveTheSameHash) {
  const TemporaryFolder folder;
  const std::string hash = driven_run(folder.file("one.bag"), 1);
  ASSERT_EQ(hash.size(), 16U);
  EXPECT_EQ(driven_run(folder.file("two.bag"), 2), hash);

  SimulatorProcess replay({kPress, "pacing:=lockstep", "threads:=2", "commands:=" + folder.file("one.bag"),
                           "record:=" + folder.file("replay.bag")});
  ASSERT_TRUE(replay.ready()) << replay.log();
  EXPECT_FALSE(replay.step(1, {velocity("plate", 1.0)}).success);  // recorded commands only
  EXPECT_TRUE(replay.step(10000).success);
  replay.signal(SIGINT);
  EXPECT_EQ(replay.wait(), 0) << replay.log();
  EXPECT_EQ(hash_in(folder.file("replay.bag")), hash);

  // The same without stepping: as fast as possible to the end of the scene, which ends the node.
  SimulatorProcess free({kPress, "pacing:=free", "threads:=1", "commands:=" + folder.file("one.bag"),
                         "record:=" + folder.file("free.bag")});
  EXPECT_EQ(free.wait(), 0) << free.log();
  EXPECT_EQ(hash_in(folder.file("free.bag")), hash);
}

TEST(Lockstep, BadCommandsAreRefusedAndChangeNothing) {
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  Ear<mpm_ros::Command> commands(simulator.name("commands"));
  ASSERT_TRUE(diagnostics.connected() && commands.connected());

  geometry_msgs::Twist twist;
  twist.linear.x = kNaN;
  say(simulator.name("bodies/plate/cmd_vel"), twist);
  EXPECT_TRUE(diagnosed(diagnostics, simulator, "linear.x is nan"));

  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = "world";
  say(simulator.name("bodies/plate/cmd_pose"), pose);
  EXPECT_TRUE(diagnosed(diagnostics, simulator, "quaternion has norm 0"));

  geometry_msgs::TwistStamped stamped;
  stamped.header.frame_id = "nowhere";
  stamped.twist.linear.z = 1.0;
  say(simulator.name("bodies/plate/cmd_vel_stamped"), stamped);
  EXPECT_TRUE(diagnosed(diagnostics, simulator, "frame 'nowhere' is not known"));

  stamped.header.frame_id = std::string(1000, 'x');
  say(simulator.name("bodies/plate/cmd_vel_stamped"), stamped);
  EXPECT_TRUE(diagnosed(diagnostics, simulator, "the most is 255"));

  stamped.header.frame_id = "world";
  stamped.header.stamp = ros::Time(1'700'000'000, 0);  // a stamp of the wall clock, in simulated time
  say(simulator.name("bodies/plate/cmd_vel_stamped"), stamped);
  EXPECT_TRUE(diagnosed(diagnostics, simulator, "the same clock"));

  // The node has no subscriber there, so it asks the master.
  const ros::Publisher stranger =
      ros::NodeHandle().advertise<geometry_msgs::Twist>(simulator.name("bodies/plat/cmd_vel"), 1);
  EXPECT_TRUE(diagnosed(diagnostics, simulator, "there is no rigid body 'plat'"));
  EXPECT_NE(simulator.log().find("did you mean 'plate'"), std::string::npos);

  Step::Response response = simulator.step(1, {velocity("plate", -0.1), velocity("blade", 1.0)});
  EXPECT_FALSE(response.success);
  EXPECT_NE(response.message.find("there is no rigid body 'blade'"), std::string::npos);
  EXPECT_EQ(response.time, 0.0);
  response = simulator.step(1, {velocity("plate", kNaN)});
  EXPECT_FALSE(response.success);
  mpm_ros::Command kindless = velocity("plate", 1.0);
  kindless.kind = 7;
  EXPECT_FALSE(simulator.step(1, {kindless}).success);
  Step::Request request;
  request.duration = -1.0;
  EXPECT_FALSE(simulator.step(request).success);

  response = simulator.step(3);
  ASSERT_TRUE(response.success);
  EXPECT_EQ(response.bodies.bodies[0].pose.position.z, 0.065);  // its initial pose
  EXPECT_EQ(response.bodies.bodies[0].twist.linear.z, 0.0);
  EXPECT_EQ(response.bodies.bodies[0].drive, BodyState::FUNCTIONS);
  EXPECT_TRUE(commands.heard().empty());
}

TEST(Lockstep, FramesTurnCommands) {
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1", "set:=[time.end=100]"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  // The sensor's x axis points along the world's z.
  static tf2_ros::StaticTransformBroadcaster broadcaster;
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = ros::TIME_MIN;
  transform.header.frame_id = "world";
  transform.child_frame_id = "sensor";
  transform.transform.translation.x = 0.17;
  transform.transform.rotation.w = std::sqrt(0.5);
  transform.transform.rotation.y = -std::sqrt(0.5);
  broadcaster.sendTransform(transform);

  geometry_msgs::TwistStamped twist;
  twist.header.frame_id = "sensor";
  twist.twist.linear.x = 0.01;
  Step::Response response;
  // The transform and the command arrive at different times: the command is repeated until both have arrived.
  ASSERT_TRUE(eventually([&] {
    say(simulator.name("bodies/rod/cmd_vel_stamped"), twist);
    response = simulator.step(1);
    return response.bodies.bodies[1].drive == BodyState::VELOCITY;
  }));
  // Two products of numbers near 1: an error of a few units in the last place.
  EXPECT_NEAR(response.bodies.bodies[1].twist.linear.z, 0.01, 1e-15);
  EXPECT_NEAR(response.bodies.bodies[1].twist.linear.x, 0.0, 1e-15);

  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = "sensor";
  pose.header.stamp = response.stamp + ros::Duration(0.05);
  pose.pose.position.x = 0.09;  // 0.09 above the sensor's origin, which lies at x = 0.17, z = 0
  pose.pose.orientation.w = std::sqrt(0.5);
  pose.pose.orientation.y = std::sqrt(0.5);  // turns the sensor's axes back to the world's
  say(simulator.name("bodies/rod/cmd_pose"), pose);
  ASSERT_TRUE(steps_until(simulator, [&](const Step::Response& r) { return r.stamp > pose.header.stamp; }));
  response = simulator.step(1);
  EXPECT_EQ(response.bodies.bodies[1].drive, BodyState::POSE);
  EXPECT_NEAR(response.bodies.bodies[1].pose.position.x, 0.17, 1e-12);
  EXPECT_NEAR(response.bodies.bodies[1].pose.position.z, 0.09, 1e-12);
  EXPECT_NEAR(std::abs(response.bodies.bodies[1].pose.orientation.w), 1.0, 1e-12);
  EXPECT_EQ(response.bodies.bodies[1].twist.linear.z, 0.0);  // it has arrived
}

TEST(Lockstep, CommandsInABodysOwnAxes) {
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  mpm_ros::Command turn;
  turn.body = "rod";
  turn.kind = mpm_ros::Command::POSE;
  turn.pose.position.x = 0.17;
  turn.pose.position.z = 0.1;
  turn.pose.orientation.w = std::sqrt(0.5);
  turn.pose.orientation.y = -std::sqrt(0.5);  // the x axis points up
  ASSERT_TRUE(simulator.step(10, {turn}).success);
  mpm_ros::Command forward = velocity("rod", 0.0);
  forward.header.frame_id = "rod";
  forward.twist.linear.x = 0.02;
  const Step::Response response = simulator.step(1, {forward});
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_NEAR(response.bodies.bodies[1].twist.linear.z, 0.02, 1e-15);
}

TEST(Lockstep, PauseRefusesStepsAndResetBeginsAgain) {
  const TemporaryFolder folder;
  SimulatorProcess simulator(
      {kPress, "pacing:=lockstep", "threads:=1", "state_hash:=true", "record:=" + folder.file("run.bag")});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  std_srvs::SetBool pause;
  pause.request.data = 1;
  ASSERT_TRUE(simulator.call("pause", pause));
  EXPECT_TRUE(pause.response.success);
  Step::Response refused = simulator.step(1);
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("paused"), std::string::npos);
  pause.request.data = 0;
  ASSERT_TRUE(simulator.call("pause", pause));

  const Step::Response first = simulator.step(20, {velocity("plate", -0.2)});
  ASSERT_TRUE(first.success);
  std_srvs::Trigger reset;
  ASSERT_TRUE(simulator.call("reset", reset));
  EXPECT_TRUE(reset.response.success) << reset.response.message;
  const Step::Response again = simulator.step(20, {velocity("plate", -0.2)});
  ASSERT_TRUE(again.success);
  EXPECT_EQ(again.time, first.time);
  EXPECT_GT(again.stamp, first.stamp);  // stamps never go back
  EXPECT_EQ(again.contact_forces.bodies[0].wrench, first.contact_forces.bodies[0].wrench);

  simulator.signal(SIGINT);
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  // A bag holds one run, and both runs end in the same state.
  EXPECT_EQ(hash_in(folder.file("run.bag")), hash_in(folder.file("run_2.bag")));
}

TEST(Lockstep, TheEndOfTheSceneEndsTheSteps) {
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1", "set:=[time.end=0.05]"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  const Step::Response last = simulator.step(1000);
  EXPECT_TRUE(last.success);
  EXPECT_NEAR(last.time, 0.05, 1e-9);
  EXPECT_FALSE(simulator.step(1).success);
  Ear<SolverState> state(simulator.name("solver_state"));  // latched
  ASSERT_TRUE(state.hears(1));
  EXPECT_EQ(state.heard()[0].state_hash.size(), 16U);
}

}  // namespace lockstep_node_test
}  // namespace mpm_ros::test
