// A node that survives: a failed run leaves it waiting for a reset or a checkpoint in every pacing, a step can be
// interrupted, a reset sets other values in the scene, and a paused run can be stepped.
#include <geometry_msgs/TwistStamped.h>
#include <mpm_ros/BodyStates.h>
#include <mpm_ros/Checkpoint.h>
#include <mpm_ros/Reset.h>
#include <mpm_ros/RunInfo.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <atomic>
#include <thread>

#include "mpm/checkpoint/checkpoint.hpp"
#include "simulator_process.hpp"
#include "test_files.hpp"

namespace mpm_ros::test {
namespace alive_node_test {

const std::string kPress = "scene:=" + data_file("press.yaml");
const std::string kFails = "scene:=" + data_file("leaves_domain.yaml");

std_srvs::Trigger::Response reset(const SimulatorProcess& simulator) {
  std_srvs::Trigger call;
  EXPECT_TRUE(simulator.call("reset", call)) << simulator.log();
  return call.response;
}

Reset::Response reset_with(const SimulatorProcess& simulator, const std::vector<std::string>& set) {
  Reset call;
  call.request.set = set;
  EXPECT_TRUE(simulator.call("reset_with", call)) << simulator.log();
  return call.response;
}

std_srvs::SetBool::Response pause(const SimulatorProcess& simulator, bool paused) {
  std_srvs::SetBool call;
  call.request.data = paused ? 1 : 0;
  EXPECT_TRUE(simulator.call("pause", call)) << simulator.log();
  return call.response;
}

bool says(const SimulatorProcess& simulator, const std::string& text) {
  return eventually([&] { return simulator.log().find(text) != std::string::npos; });
}

/// The block leaves the domain: its front is 0.11 m from the edge and flies with 2 m/s, so the run fails before 0.06 s.
void expect_waits_after_failure(const std::string& pacing) {
  const TemporaryFolder folder;
  SimulatorProcess simulator({kFails, "pacing:=" + pacing, "keep_alive:=true", "threads:=1", "start_paused:=true",
                              "record:=" + folder.file("run.bag")});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Checkpoint save;
  save.request.path = folder.file("start.h5");
  ASSERT_TRUE(simulator.call("save_checkpoint", save));
  ASSERT_TRUE(save.response.success) << save.response.message;
  pause(simulator, false);
  if (pacing == "lockstep") {
    EXPECT_FALSE(simulator.step(1000).success);
  }
  ASSERT_TRUE(says(simulator, "the node waits for reset")) << simulator.log();
  // The record is closed and the state saved while the node lives.
  const SolverState last = last_state_in(folder.file("run.bag"));
  EXPECT_TRUE(last.failed);
  EXPECT_EQ(mpm::read_checkpoint(folder.file("run_failed.h5")).label.failure, last.failure);
  const Step::Response refused = simulator.step(1);
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("call reset"), std::string::npos) << refused.message;
  EXPECT_TRUE(refused.bodies.bodies.empty());

  // It begins again without the throw, and again from the checkpoint, which fails again.
  pause(simulator, true);
  const Reset::Response again = reset_with(simulator, {"bodies.0.initial.velocity=[0, 0]", "time.end=0.2"});
  ASSERT_TRUE(again.success) << again.message;
  EXPECT_EQ(again.run, 2U);
  EXPECT_EQ(again.bag, folder.file("run_2.bag"));
  pause(simulator, false);
  if (pacing == "lockstep") {
    EXPECT_TRUE(simulator.step(1000).success);
  }
  ASSERT_TRUE(eventually([&] { return simulator.step(1).message.find("has ended") != std::string::npos; }));
  ASSERT_TRUE(reset_with(simulator, {}).success);
  pause(simulator, true);
  Checkpoint load;
  load.request.path = save.response.path;
  ASSERT_TRUE(simulator.call("load_checkpoint", load));
  EXPECT_TRUE(load.response.success) << load.response.message;
  pause(simulator, false);
  if (pacing == "lockstep") {
    EXPECT_FALSE(simulator.step(1000).success);
  }
  ASSERT_TRUE(eventually([&] { return simulator.step(1).message.find("call reset") != std::string::npos; }));
  // A node whose last run failed ends with the code of that failure.
  simulator.signal(SIGINT);
  EXPECT_EQ(simulator.wait(), 3) << simulator.log();
  EXPECT_FALSE(last_state_in(folder.file("run_2.bag")).failed);
  EXPECT_TRUE(last_state_in(folder.file("run_4.bag")).failed);
}

TEST(Alive, FailedRunWaitsInLockstep) { expect_waits_after_failure("lockstep"); }
TEST(Alive, FailedRunWaitsWhenFree) { expect_waits_after_failure("free"); }
TEST(Alive, FailedRunWaitsInRealTime) { expect_waits_after_failure("real_time"); }

TEST(Alive, ResetSetsOtherValuesAndKeepsThem) {
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1", "set:=[time.end=100, time.sync=0.002]"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<RunInfo> infos(simulator.name("run_info"));
  ASSERT_TRUE(infos.hears(1));
  ASSERT_TRUE(simulator.step(3).success);

  Reset::Response response = reset_with(simulator, {"rigid_bodies.0.pose.position=[0.1, 0.08]", "time.sync=0.004"});
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_EQ(response.time, 0.0);
  ASSERT_EQ(response.bodies.bodies.size(), 2U);
  EXPECT_EQ(response.bodies.bodies[0].pose.position.z, 0.08);
  EXPECT_TRUE(response.bag.empty());
  ASSERT_TRUE(infos.hears(2));
  EXPECT_NE(infos.heard()[1].parameters.find("reset_with: [\"rigid_bodies.0.pose.position=[0.1, 0.08]\""),
            std::string::npos)
      << infos.heard()[1].parameters;
  EXPECT_EQ(infos.heard()[1].sync_period, 0.004);
  // A command takes its sync periods from the new scene: 0.1 m/s for five of 4 ms.
  const Step::Response step = simulator.step(5, {velocity("plate", -0.1)});
  EXPECT_NEAR(step.time, 0.02, 1e-12);
  EXPECT_NEAR(step.bodies.bodies[0].pose.position.z, 0.08 - 0.1 * 0.02, 1e-12);

  // reset begins the scene as it is now; reset_with with nothing as the node began.
  EXPECT_TRUE(reset(simulator).success);
  EXPECT_EQ(simulator.step(1).bodies.bodies[0].pose.position.z, 0.08);
  EXPECT_EQ(reset_with(simulator, {}).bodies.bodies[0].pose.position.z, 0.065);

  // Refuses what cannot be, and the run goes on.
  ASSERT_TRUE(simulator.step(7).success);
  response = reset_with(simulator, {"grid.cel=0.02"});
  EXPECT_FALSE(response.success);
  EXPECT_NE(response.message.find("cel"), std::string::npos) << response.message;
  response = reset_with(simulator, {"rigid_bodies.0.name=spade"});
  EXPECT_FALSE(response.success);
  EXPECT_NE(response.message.find("names of rigid bodies"), std::string::npos) << response.message;
  EXPECT_NEAR(simulator.step(1).time, 8 * 0.002, 1e-12);
}

TEST(Alive, PauseInterruptsStepsInLine) {
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1", "set:=[time.end=1e6, time.sync=0.002]"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<BodyStates> bodies(simulator.name("bodies"));
  ASSERT_TRUE(bodies.connected());
  // Eight that would each take months.
  std::vector<std::thread> callers;
  std::atomic<int> advanced{0}, untouched{0};
  for (int i = 0; i < 8; ++i) {
    callers.emplace_back([&] {
      Step step;
      step.request.count = 1U << 31U;
      ASSERT_TRUE(simulator.call("step", step));
      EXPECT_FALSE(step.response.success);
      const std::string& message = step.response.message;
      if (message.find("interrupted by pause") != std::string::npos) {
        ++advanced;
        EXPECT_NE(message.find("of 2147483648 sync periods"), std::string::npos) << message;
        EXPECT_GT(step.response.time, 0.0);
        EXPECT_EQ(step.response.bodies.bodies.size(), 2U);
      } else {
        ++untouched;
        EXPECT_NE(message.find("paused"), std::string::npos) << message;
        EXPECT_TRUE(step.response.bodies.bodies.empty());
      }
    });
  }
  ASSERT_TRUE(bodies.hears(5)) << simulator.log();
  ros::WallDuration(0.5).sleep();  // for all eight to be in line
  const ros::WallTime asked = ros::WallTime::now();
  EXPECT_TRUE(pause(simulator, true).success);
  EXPECT_LT((ros::WallTime::now() - asked).toSec(), 1.0);
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(advanced, 1);
  EXPECT_EQ(untouched, 7);
  pause(simulator, false);
  EXPECT_TRUE(simulator.step(1).success);
}

TEST(Alive, APausedRunIsSteppedInRealTime) {
  SimulatorProcess simulator({kPress, "threads:=1", "start_paused:=true", "set:=[time.end=100, time.sync=0.002]"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  const Step::Response step = simulator.step(10, {velocity("plate", -0.1)});
  ASSERT_TRUE(step.success) << step.message;
  EXPECT_NEAR(step.time, 0.02, 1e-12);
  EXPECT_NEAR(step.bodies.bodies[0].pose.position.z, 0.065 - 0.1 * 0.02, 1e-12);
  pause(simulator, false);
  const Step::Response refused = simulator.step(1);
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("pause"), std::string::npos) << refused.message;
  EXPECT_TRUE(refused.bodies.bodies.empty());
  EXPECT_GE(refused.time, 0.02);
}

TEST(Alive, StampedCommandsInTheQueueAreBounded) {
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1", "set:=[time.end=1e6, time.sync=0.002]"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  ros::Publisher publisher =
      ros::NodeHandle().advertise<geometry_msgs::TwistStamped>(simulator.name("bodies/rod/cmd_vel_stamped"), 20000);
  ASSERT_TRUE(eventually([&] { return publisher.getNumSubscribers() > 0; }));
  geometry_msgs::TwistStamped command;
  command.header.stamp = ros::Time(601, 0);  // a minute more than ten
  publisher.publish(command);
  EXPECT_TRUE(diagnosed(diagnostics, simulator, "601 s ahead of the simulation, and at most 600 s"));
  // A subscriber holds a thousand and drops others, so the number that it takes depends on the load.
  std::atomic<bool> refused{false};
  std::thread sender([&] {
    for (int i = 0; !refused; ++i) {
      command.header.stamp = ros::Time(10, 0) + ros::Duration(0.01 * (i % 50'000));
      publisher.publish(command);
      if (i % 500 == 0) ros::WallDuration(0.05).sleep();
    }
  });
  EXPECT_TRUE(diagnosed(diagnostics, simulator, "10000 commands wait for their time already"));
  refused = true;
  sender.join();
  EXPECT_TRUE(simulator.step(500).success);
  // A command of a step is not held up by them.
  EXPECT_TRUE(simulator.step(1, {velocity("plate", -0.1)}).success);
}

TEST(Alive, ACommandCopiedToARequestHasNoStampThatIsIgnored) {
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  Ear<mpm_ros::Command> applied(simulator.name("commands"));
  ASSERT_TRUE(applied.connected());
  mpm_ros::Command copied = velocity("plate", -0.1);
  copied.requested = ros::Time(3.0);
  ASSERT_TRUE(simulator.step(1, {copied}).success);
  ASSERT_TRUE(applied.hears(1));
  EXPECT_EQ(applied.heard()[0].requested, ros::Time(3.0));
  EXPECT_FALSE(applied.heard()[0].stamp_ignored);
}

TEST(Alive, AVelocityOutOfThePlaneIsRefused) {
  SimulatorProcess simulator({kPress, "pacing:=lockstep", "threads:=1"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  mpm_ros::Command aside = velocity("plate", -0.1);
  aside.twist.linear.y = 0.05;
  Step::Response refused = simulator.step(1, {aside});
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("is not one of a plane_strain scene: 'plate' moves along x and z"), std::string::npos)
      << refused.message;
  aside.twist.linear.y = 0.0;
  aside.twist.angular.z = 1.0;
  EXPECT_FALSE(simulator.step(1, {aside}).success);
  aside.twist.angular.z = 1e-18;  // the round-off of a change of axes
  aside.twist.angular.y = 0.1;
  EXPECT_TRUE(simulator.step(1, {aside}).success);
}

TEST(Alive, ABodyIsNotPushedAcrossTheDomain) {
  SimulatorProcess simulator({"scene:=" + data_file("free_ball.yaml"), "pacing:=lockstep", "threads:=1"});
  ASSERT_TRUE(simulator.ready()) << simulator.log();
  mpm_ros::Command push;
  push.body = simulator.step(1).bodies.bodies.at(0).name;
  push.kind = mpm_ros::Command::WRENCH;
  push.wrench.force.z = 1e30;
  const Step::Response refused = simulator.step(1, {push});
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("more than the domain's diagonal"), std::string::npos) << refused.message;
  push.wrench.force.z = 1.0;
  EXPECT_TRUE(simulator.step(1, {push}).success);
}

}  // namespace alive_node_test
}  // namespace mpm_ros::test
