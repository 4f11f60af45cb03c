// The program of all node tests, a ROS node itself. Which file's cases run, --file=NAME_node says
// (test/main/choose_tests.hpp). Two other words make it a node that a test needs beside it.
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <cstdlib>
#include <cstring>

#include "choose_tests.hpp"
#include "simulator_process.hpp"

namespace mpm_ros::test {
namespace determinism_node_test {
int send(int argc, char** argv, char** words);
}
namespace pacing_node_test {
int wait_for_time(int argc, char** argv);
}
}  // namespace mpm_ros::test

int main(int argc, char** argv) {
  namespace test = mpm_ros::test;
  // Arguments of ROS may come first. A sender that was not recognised here would start the tests again, endlessly.
  for (int i = 1; i < argc; ++i) {
    if (i + 3 < argc && std::strcmp(argv[i], "--sender") == 0) {
      return test::determinism_node_test::send(argc, argv, argv + i + 1);
    }
    if (std::strcmp(argv[i], "--wait-for-time") == 0) return test::pacing_node_test::wait_for_time(argc, argv);
  }
  if (std::getenv(test::kChild) != nullptr) return 1;
  setenv(test::kChild, "1", 1);
  testing::InitGoogleTest(&argc, argv);
  setenv("OMP_WAIT_POLICY", "passive", 1);  // several simulators share the cores
  ros::init(argc, argv, "node_tests");      // it takes the arguments that are ROS's
  if (const int result = choose_tests(argc, argv); result != 0) return result;
  ros::start();
  ros::AsyncSpinner spinner(1);
  spinner.start();
  const int result = RUN_ALL_TESTS();
  ros::shutdown();
  return result;
}
