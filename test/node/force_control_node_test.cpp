// The example controller presses a probe into foam until the force settles: within 2 % in lockstep, and within 5 % in
// real time through topics. Its exit code reports success.
#include "simulator_process.hpp"

namespace mpm_ros::test {
namespace force_control_node_test {

/// Runs the controller for 4 s of simulated time. Returns the hash of the end; `said` is the controller's output.
std::string controlled_run(const std::string& pacing, const std::string& tolerance, std::string& said) {
  const TemporaryFolder folder;
  const std::string bag = folder.file("run.bag");
  SimulatorProcess simulator({"scene:=foam_probe", "threads:=1", "pacing:=" + pacing, "wrench_rate:=100.0",
                              "command_timeout:=0.5", "on_timeout:=stop", "record:=" + bag});
  ProgramProcess controller("force_controller",
                            {"_duration:=4.0", "_tolerance:=" + tolerance,
                             std::string("_lockstep:=") + (pacing == "lockstep" ? "true" : "false")},
                            simulator.name_space());
  EXPECT_EQ(controller.wait(), 0) << controller.log() << simulator.log();
  said = controller.log();
  simulator.signal(SIGINT);
  EXPECT_EQ(simulator.wait(), 0) << simulator.log();
  return hash_in(bag);
}

TEST(ForceControl, SettlesInLockstepTheSameEachTime) {
  std::string said;
  const std::string hash = controlled_run("lockstep", "0.02", said);
  EXPECT_NE(said.find("settled within 2 %"), std::string::npos) << said;
  std::cout << said;
  EXPECT_EQ(controlled_run("lockstep", "0.02", said), hash);
}

TEST(ForceControl, SettlesInRealTimeThroughTopics) {
  std::string said;
  controlled_run("real_time", "0.05", said);
  EXPECT_NE(said.find("settled within 5 %"), std::string::npos) << said;
  std::cout << said;
}

TEST(ForceControl, AParameterThatMakesNoSenseIsNamed) {
  ProgramProcess controller("force_controller", {"_target:=-1.0"});
  EXPECT_EQ(controller.wait(), 2);
  EXPECT_NE(controller.log().find("parameter ~target is -1"), std::string::npos) << controller.log();
}

}  // namespace force_control_node_test
}  // namespace mpm_ros::test
