// Bodies of the node that follow tf frames or have limits, in lockstep: their poses by stamp, published transforms, the
// effect of silence, and the replay of the bag. The scene's sync points are 2 ms apart; its sled is limited to 0.4 m/s
// and 20 m/s^2, which is 0.04 m/s a sync period.
#include <mpm_ros/BodyStates.h>
#include <mpm_ros/RunInfo.h>
#include <std_srvs/Trigger.h>
#include <tf2_msgs/TFMessage.h>

#include <fstream>
#include <set>

#include "simulator_process.hpp"
#include "test_files.hpp"

namespace mpm_ros::test {
namespace drive_node_test {

const std::string kDrive = "scene:=" + data_file("drive.yaml");
constexpr int kProbe = 0, kHand = 1, kSled = 2;
constexpr double kRound = 1e-12;  // round-off of positions of 0.1 m, interpolated by tf

/// Transforms of a frame that moves along x from `x` on at 0.05 m/s, stamped from 1 ns to `end` [s].
tf2_msgs::TFMessage way(const std::string& frame, double x, double z, double end) {
  tf2_msgs::TFMessage message;
  for (const double time : {1e-9, end}) {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = "world";
    transform.header.stamp = ros::Time(time);
    transform.child_frame_id = frame;
    transform.transform.translation.x = x + 0.05 * time;
    transform.transform.translation.z = z;
    transform.transform.rotation.w = 1.0;
    message.transforms.push_back(transform);
  }
  return message;
}

class Drive : public testing::Test {
 protected:
  ros::Publisher tf_ = ros::NodeHandle().advertise<tf2_msgs::TFMessage>("/tf", 10);
  Ear<diagnostic_msgs::DiagnosticArray> diagnostics_{"/diagnostics"};

  /// Sends transforms and steps until the body follows them, since topics may arrive later than service calls.
  void send(const SimulatorProcess& simulator, const tf2_msgs::TFMessage& message, int body) {
    ASSERT_TRUE(eventually([&] { return tf_.getNumSubscribers() > 0; })) << simulator.log();
    ASSERT_TRUE(eventually([&] {
      tf_.publish(message);
      return simulator.step(1).bodies.bodies[static_cast<std::size_t>(body)].drive == BodyState::POSE;
    })) << simulator.log();
  }
};

geometry_msgs::Point place(const Step::Response& response, int body) {
  return response.bodies.bodies[static_cast<std::size_t>(body)].pose.position;
}

TEST_F(Drive, ABodyIsWhereItsFrameIsByTheStampAndTheBagReplays) {
  const TemporaryFolder folder;
  const std::string bag = folder.file("run.bag");
  std::string hash;
  {
    SimulatorProcess simulator({kDrive, "pacing:=lockstep", "threads:=1", "record:=" + bag});
    ASSERT_TRUE(simulator.ready()) << simulator.log();
    const Step::Response first = simulator.step(1);
    ASSERT_TRUE(first.success);
    EXPECT_EQ(place(first, kProbe).x, 0.1);  // it waits at its initial pose
    EXPECT_TRUE(diagnosed(diagnostics_, simulator, "'probe' waits for the tf frame 'arm/tool0'"));
    EXPECT_TRUE(diagnosed(diagnostics_, simulator, "'hand' waits for the tf frame 'hand'"));

    // Stamps are ahead of the simulation, so there is a transform for each sync point.
    send(simulator, way("arm/tool0", 0.1, 0.06, 0.15), kProbe);
    for (int i = 0; i < 5; ++i) {
      const Step::Response response = simulator.step(3);
      ASSERT_TRUE(response.success);
      EXPECT_NEAR(place(response, kProbe).x, 0.1 + 0.05 * response.time, kRound);
      EXPECT_NEAR(place(response, kProbe).z, 0.06, kRound);
      EXPECT_EQ(place(response, kHand).x, 0.16);  // its frame does not exist
    }
    // The limited body is commanded to a pose that it cannot reach in time.
    mpm_ros::Command pose;
    pose.body = "sled";
    pose.kind = mpm_ros::Command::POSE;
    pose.pose.position.x = 0.025;
    pose.pose.position.z = 0.1;
    pose.pose.orientation.w = 1.0;
    const Step::Response asked = simulator.step(1, {pose});
    ASSERT_TRUE(asked.success);
    EXPECT_NEAR(asked.bodies.bodies[kSled].twist.linear.x, 0.04, 1e-9);  // 2.5 m/s is commanded
    EXPECT_EQ(asked.bodies.bodies[kSled].drive, BodyState::POSE);
    ASSERT_TRUE(simulator.step(1).success);
    EXPECT_TRUE(diagnosed(diagnostics_, simulator, "'sled' is behind its pose"));
    const Step::Response late = simulator.step(30);
    EXPECT_EQ(place(late, kSled).x, 0.025);
    EXPECT_EQ(late.bodies.bodies[kSled].twist.linear.x, 0.0);

    const Step::Response last = simulator.step(1000);  // to the end of the scene
    EXPECT_TRUE(last.success);
    EXPECT_NEAR(place(last, kProbe).x, 0.1 + 0.05 * 0.15, kRound);  // place where the frame stopped
    simulator.signal(SIGINT);
    EXPECT_EQ(simulator.wait(), 0) << simulator.log();
    hash = hash_in(bag);
    ASSERT_EQ(hash.size(), 16U);
  }
  const std::string again = folder.file("again.bag");
  SimulatorProcess replay({kDrive, "pacing:=free", "threads:=2", "commands:=" + bag, "record:=" + again});
  EXPECT_EQ(replay.wait(), 0) << replay.log();
  EXPECT_EQ(hash_in(again), hash);
}

TEST_F(Drive, AFrameIsNotPublishedAgain) {
  SimulatorProcess simulator({kDrive, "pacing:=lockstep", "threads:=1"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<tf2_msgs::TFMessage> ear("/tf");
  ASSERT_TRUE(eventually([&] {
    simulator.step(1);
    return ear.heard().size() >= 3;
  }));
  std::set<std::string> frames;
  for (const tf2_msgs::TFMessage& message : ear.heard()) {
    for (const geometry_msgs::TransformStamped& transform : message.transforms) frames.insert(transform.child_frame_id);
  }
  // The probe has a frame of its own beside that of the link; the hand uses that of the link.
  EXPECT_EQ(frames, (std::set<std::string>{"probe", "sled"}));
}

TEST_F(Drive, OtherCommandsAreRefused) {
  SimulatorProcess simulator({kDrive, "pacing:=lockstep", "threads:=1"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  const Step::Response response = simulator.step(1, {velocity("probe", 0.1)});
  EXPECT_FALSE(response.success);
  EXPECT_NE(response.message.find("it follows the tf frame 'arm/tool0'"), std::string::npos) << response.message;
}

TEST_F(Drive, SilenceStopsALimitedBodyWithinItsLimits) {
  SimulatorProcess simulator({kDrive, "pacing:=lockstep", "threads:=1", "command_timeout:=0.02", "on_timeout:=stop"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  mpm_ros::Command command = velocity("sled", 0.0);
  command.twist.linear.x = 1.0;
  // It accelerates to 0.4 m/s in ten periods, until the command has been silent for 0.02 s, and comes to rest in the
  // next ten: 0.04 m/s times 2 ms times 55 and 45.
  Step::Response response = simulator.step(10, {command});
  EXPECT_NEAR(response.bodies.bodies[kSled].twist.linear.x, 0.4, kRound);
  EXPECT_NEAR(place(response, kSled).x, 0.02 + 0.04 * 0.002 * 55, kRound);
  response = simulator.step(9);
  EXPECT_NEAR(response.bodies.bodies[kSled].twist.linear.x, 0.04, kRound);
  response = simulator.step(5);
  EXPECT_EQ(response.bodies.bodies[kSled].twist.linear.x, 0.0);
  EXPECT_NEAR(place(response, kSled).x, 0.02 + 0.04 * 0.002 * 100, kRound);
  EXPECT_TRUE(diagnosed(diagnostics_, simulator, "no command for 'sled'"));
  // It follows commands again, from rest.
  response = simulator.step(1, {command});
  EXPECT_NEAR(response.bodies.bodies[kSled].twist.linear.x, 0.04, kRound);
}

TEST_F(Drive, SilenceOfAFrameHoldsItsLastPlaceOrEndsTheRun) {
  for (const std::string setting : {"hold", "stop", "error"}) {
    SCOPED_TRACE(setting);
    SimulatorProcess simulator({kDrive, "pacing:=lockstep", "threads:=1", "command_timeout:=0.03", "keep_alive:=false",
                                "on_timeout:=" + setting});
    ASSERT_TRUE(simulator.ready()) << simulator.log();
    send(simulator, way("arm/tool0", 0.1, 0.06, 0.05), kProbe);
    const Step::Response response = simulator.step(45);  // not to the end of the scene, where the node ends
    EXPECT_EQ(response.success, setting != "error") << response.message;
    EXPECT_NEAR(place(response, kProbe).x, 0.1 + 0.05 * 0.05, kRound);
    if (setting == "error") {
      EXPECT_NE(response.message.find("no command for 'probe'"), std::string::npos) << response.message;
      EXPECT_NEAR(response.time, 0.08, 1e-9);  // the last pose is reached at 0.05 s
      EXPECT_EQ(simulator.wait(), 3) << simulator.log();
    } else {
      EXPECT_EQ(response.bodies.bodies[kProbe].drive, setting == "stop" ? BodyState::VELOCITY : BodyState::POSE);
      EXPECT_TRUE(diagnosed(diagnostics_, simulator, "no command for 'probe'"));
    }
  }
}

TEST_F(Drive, AJumpIsTold) {
  SimulatorProcess simulator({kDrive, "pacing:=lockstep", "threads:=1"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  // The link is 4 cells from the body's initial pose: the body moves there in one period, and this is reported.
  send(simulator, way("hand", 0.12, 0.08, 0.15), kHand);
  EXPECT_TRUE(diagnosed(diagnostics_, simulator, "'hand' jumps")) << simulator.log();
}

// A body whose scene has no pose begins where its frame is, which the node waits for, at the start and at a reset.
TEST_F(Drive, WithoutAPoseABodyBeginsWhereItsFrameIs) {
  const TemporaryFolder folder;
  std::ifstream given(data_file("drive.yaml"));
  std::ofstream scene(folder.file("drive.yaml"));
  for (std::string line; std::getline(given, line);) {
    if (line.find("pose: {position: [0.1, 0.06]}") == std::string::npos) scene << line << "\n";
  }
  scene.close();
  const std::string bag = folder.file("run.bag");
  SimulatorProcess simulator(
      {"scene:=" + folder.file("drive.yaml"), "pacing:=lockstep", "threads:=1", "record:=" + bag});
  ASSERT_TRUE(eventually([&] {
    return simulator.log().find("waits for the tf frame 'arm/tool0' in 'world', where 'probe' begins") !=
           std::string::npos;
  })) << simulator.log();
  EXPECT_FALSE(ros::service::exists(simulator.name("step"), false));
  ASSERT_TRUE(eventually([&] { return tf_.getNumSubscribers() > 0; })) << simulator.log();
  ASSERT_TRUE(eventually([&] {
    tf_.publish(way("arm/tool0", 0.12, 0.07, 1e-9));
    return ros::service::exists(simulator.name("step"), false);
  })) << simulator.log();
  const geometry_msgs::Point at = place(simulator.step(1), kProbe);
  EXPECT_NEAR(at.x, 0.12 + 0.05e-9, kRound);
  EXPECT_NEAR(at.z, 0.07, kRound);
  EXPECT_EQ(simulator.log().find("jumps"), std::string::npos) << simulator.log();

  // It follows its frame, and a reset begins where that is by then.
  const double there = 0.14 + 0.05 * 0.01;
  ASSERT_TRUE(eventually([&] {
    tf_.publish(way("arm/tool0", 0.14, 0.07, 0.01));
    return std::abs(place(simulator.step(1), kProbe).x - there) < kRound;
  })) << simulator.log();
  std_srvs::Trigger reset;
  ASSERT_TRUE(simulator.call("reset", reset));
  EXPECT_TRUE(reset.response.success) << reset.response.message;
  EXPECT_NEAR(place(simulator.step(1), kProbe).x, there, kRound);
  simulator.signal(SIGINT);
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  rosbag::Bag recorded(bag);
  rosbag::View infos(recorded, rosbag::TypeQuery("mpm_ros/RunInfo"));
  EXPECT_NE(infos.begin()->instantiate<RunInfo>()->scene_text.find("0.120000000"), std::string::npos);
}

}  // namespace drive_node_test
}  // namespace mpm_ros::test
