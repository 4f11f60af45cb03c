// Commands over the topics. Of hundreds of random commands the unusable ones are refused and counted, the others are
// applied, counted and recorded, and the node continues. And the wrench on a free body, which lasts until the next.
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/Wrench.h>
#include <geometry_msgs/WrenchStamped.h>
#include <mpm_ros/SolverState.h>

#include <cmath>
#include <limits>
#include <random>

#include "simulator_process.hpp"
#include "test_files.hpp"

namespace mpm_ros::test {
namespace commands_node_test {

const std::string kPress = "scene:=" + data_file("press.yaml");
constexpr std::uint64_t kSeed = 20240607;
constexpr int kEach = 50;  // number of each of six kinds of bad command, and of good ones
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

template <typename Message>
ros::Publisher connect(const std::string& topic) {
  ros::Publisher publisher = ros::NodeHandle().advertise<Message>(topic, 1000);
  EXPECT_TRUE(eventually([&] { return publisher.getNumSubscribers() > 0; })) << topic;
  return publisher;
}

TEST(Commands, RandomOnesAreRefusedOrAppliedAndCounted) {
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937_64 dice(kSeed);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(dice); };
  const TemporaryFolder folder;
  const std::string bag = folder.file("run.bag");
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1", "record:=" + bag, "set:=[time.end=1000]"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<SolverState> states(simulator.name("solver_state"));
  ros::Publisher twists = connect<geometry_msgs::Twist>(simulator.name("bodies/plate/cmd_vel"));
  ros::Publisher stamped = connect<geometry_msgs::TwistStamped>(simulator.name("bodies/plate/cmd_vel_stamped"));
  ros::Publisher poses = connect<geometry_msgs::PoseStamped>(simulator.name("bodies/plate/cmd_pose"));
  ros::Publisher rod = connect<geometry_msgs::Twist>(simulator.name("bodies/rod/cmd_vel"));

  for (int i = 0; i < kEach; ++i) {
    geometry_msgs::Twist twist;
    twist.linear.x = uniform(-1.0, 1.0) > 0.0 ? kNaN : std::numeric_limits<double>::infinity();
    twists.publish(twist);
    geometry_msgs::TwistStamped frame;
    frame.header.frame_id = std::string(1 + dice() % 400, static_cast<char>(dice()));
    stamped.publish(frame);
    geometry_msgs::TwistStamped ahead;
    ahead.header.stamp = ros::Time(uniform(1e4, 1e9));
    stamped.publish(ahead);
    poses.publish(geometry_msgs::PoseStamped());
    geometry_msgs::PoseStamped longer;
    longer.header.stamp = ros::Time(uniform(0.0, 1.0));
    longer.pose.orientation.w = uniform(1.01, 1e6);
    poses.publish(longer);
    geometry_msgs::Twist good;
    good.linear.x = uniform(-0.01, 0.01);
    rod.publish(good);
    twist.linear.x = std::pow(10.0, uniform(6.0, 300.0));
    twists.publish(twist);  // refused when it is due
  }
  const auto counts = [&](std::uint64_t refused, std::uint64_t applied) {
    simulator.step(1);
    const std::vector<SolverState> heard = states.heard();
    return !heard.empty() && heard.back().commands_refused == refused && heard.back().commands_applied == applied;
  };
  ASSERT_TRUE(eventually([&] { return counts(6 * kEach, kEach); }))
      << states.heard().back().commands_refused << " refused, " << states.heard().back().commands_applied << " applied";
  // cmd_vel has no stamp and cannot be late; all others were refused.
  EXPECT_EQ(states.heard().back().commands_late, 0U);
  const Step::Response response = simulator.step(1);
  ASSERT_TRUE(response.success);
  EXPECT_EQ(response.bodies.bodies[0].pose.position.z, 0.065);  // the plate is at its initial pose
  EXPECT_EQ(response.bodies.bodies[0].drive, BodyState::FUNCTIONS);
  EXPECT_EQ(response.bodies.bodies[1].drive, BodyState::VELOCITY);

  const Step::Response many = simulator.step(1, std::vector<mpm_ros::Command>(10'001, velocity("rod", 0.0)));
  EXPECT_FALSE(many.success);
  EXPECT_NE(many.message.find("10001 commands, and a step takes 10000 at most"), std::string::npos) << many.message;

  // In its own axes, which a turn of 90 deg about y has put across the world's: its x is down, and turns on with it.
  ros::Publisher own = connect<geometry_msgs::Twist>(simulator.name("bodies/rod/cmd_vel_body"));
  mpm_ros::Command turned;
  turned.body = "rod";
  turned.kind = mpm_ros::Command::POSE;
  turned.pose = response.bodies.bodies[1].pose;
  turned.pose.orientation.w = turned.pose.orientation.y = std::sqrt(0.5);
  ASSERT_TRUE(simulator.step(1, {turned}).success);
  geometry_msgs::Twist ahead;
  ahead.linear.x = 1e-3;
  ahead.angular.y = 1.0;
  own.publish(ahead);
  Step::Request after;
  after.count = 1;
  after.after_received = many.received + 1;
  Step::Response driven = simulator.step(after);
  EXPECT_NEAR(driven.bodies.bodies[1].twist.linear.z, -1e-3, 1e-12);
  driven = simulator.step(1);  // 0.01 rad farther on
  EXPECT_NEAR(driven.bodies.bodies[1].twist.linear.x, -1e-3 * std::sin(0.01), 1e-12);

  simulator.signal(SIGINT);
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  rosbag::Bag recorded(bag);
  EXPECT_EQ(rosbag::View(recorded, rosbag::TypeQuery("mpm_ros/Command")).size(),
            static_cast<std::uint32_t>(kEach) + 3U);
}

TEST(Commands, AWrenchPushesAFreeBodyUntilTheNext) {
  const TemporaryFolder folder;
  SimulatorProcess simulator(
      {"scene:=" + data_file("free_ball.yaml"), "pacing:=lockstep", "threads:=1", "record:=" + folder.file("run.bag")});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  const Ear<mpm_ros::Command> applied(simulator.name("commands"));
  ros::Publisher now = connect<geometry_msgs::Wrench>(simulator.name("bodies/ball/cmd_wrench"));
  ros::Publisher later = connect<geometry_msgs::WrenchStamped>(simulator.name("bodies/ball/cmd_wrench_stamped"));
  const auto speed = [&](std::uint32_t steps, std::uint64_t received) {
    Step::Request request;
    request.count = steps;
    request.after_received = received;
    return simulator.step(request).bodies.bodies[0].twist.linear.x;
  };
  EXPECT_EQ(speed(1, 0), 0.0);
  geometry_msgs::Wrench wrench;
  wrench.force.x = 4.0;
  now.publish(wrench);
  // 4 N act on 2 kg from now, 0.01 s, to 0.06 s.
  EXPECT_NEAR(speed(1, 1), 0.02, 1e-12);
  geometry_msgs::WrenchStamped end;
  end.header.stamp = ros::Time(0, 60'000'000);
  end.header.frame_id = "ball";
  later.publish(end);
  EXPECT_NEAR(speed(3, 2), 0.08, 1e-12);
  EXPECT_NEAR(speed(1, 0), 0.10, 1e-12);
  EXPECT_NEAR(speed(10, 0), 0.10, 1e-12);
  ASSERT_TRUE(applied.hears(2));
  EXPECT_EQ(applied.heard()[0].kind, mpm_ros::Command::WRENCH);
  EXPECT_EQ(applied.heard()[0].wrench.force.x, 4.0);
  EXPECT_EQ(applied.heard()[1].kind, mpm_ros::Command::WRENCH);
  EXPECT_EQ(applied.heard()[1].effect_ns, 60'000'000);

  simulator.signal(SIGINT);
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  rosbag::Bag recorded(folder.file("run.bag"));
  EXPECT_EQ(rosbag::View(recorded, rosbag::TypeQuery("mpm_ros/Command")).size(), 2U);
}

}  // namespace commands_node_test
}  // namespace mpm_ros::test
