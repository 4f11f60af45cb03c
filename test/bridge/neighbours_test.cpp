// Tells what other nodes under the same master do by its answers, and the words that roscpp would abort on.
#include "mpm_ros/node/neighbours.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "mpm_ros/command/dropped_messages.hpp"
#include "mpm_ros/node/master.hpp"

namespace mpm_ros {
namespace neighbours_test {

/// [[name, [node]]]
XmlRpc::XmlRpcValue entry(const std::string& name, const std::string& node) {
  XmlRpc::XmlRpcValue list;
  list[0][0] = name;
  list[0][1][0] = node;
  return list;
}

Neighbours two_simulators() {
  XmlRpc::XmlRpcValue state;
  state[0] = entry("/clock", "/first");
  state[1].setSize(0);
  state[2] = entry("/step", "/first");
  return Neighbours(state);
}

TEST(Neighbours, AnotherSimulatorsServicesAreNotTaken) {
  const auto alive = [](const std::string&) { return true; };
  const std::string taken = taken_service(two_simulators(), "/second", {"/pause", "/step"}, alive);
  EXPECT_NE(taken.find("the node /first offers the service /step already"), std::string::npos) << taken;
  EXPECT_NE(taken.find("__ns:=mpm_2"), std::string::npos) << taken;
  EXPECT_EQ(taken_service(two_simulators(), "/first", {"/step"}, alive), "");  // its own, of a start before
  EXPECT_EQ(taken_service(two_simulators(), "/second", {"/mpm_2/step"}, alive), "");
  EXPECT_EQ(taken_service(two_simulators(), "/second", {"/step"}, [](const std::string&) { return false; }), "");
  EXPECT_EQ(taken_service(Neighbours({}), "/second", {"/step"}, alive), "");  // no answer
}

TEST(Neighbours, ASecondClockIsTold) {
  const std::string second = second_clock(two_simulators(), "/second", "/clock");
  EXPECT_NE(second.find("the node /first publishes /clock too"), std::string::npos) << second;
  EXPECT_EQ(second_clock(two_simulators(), "/first", "/clock"), "");
}

// As roscpp answers getBusStats: publications, subscriptions, services; a connection is number, bytes, messages,
// dropped.
XmlRpc::XmlRpcValue statistics(int connection, int dropped) {
  XmlRpc::XmlRpcValue all, counts;
  all[0].setSize(0);
  counts[0] = connection;
  counts[1] = 1000;
  counts[2] = 100;
  counts[3] = dropped;
  all[1][0][0] = "/mpm/bodies/blade/cmd_vel";
  all[1][0][1][0] = counts;
  all[1][1][0] = "/clock";
  all[1][1][1][0] = counts;
  all[2].setSize(0);
  return all;
}

TEST(DroppedMessages, ConnectionsThatHaveEndedStayInTheCount) {
  DroppedMessages dropped([](const std::string& topic) { return topic != "/clock"; });
  dropped.read(statistics(4, 10));
  dropped.read(statistics(4, 12));
  EXPECT_EQ(dropped.count(), 12U);
  dropped.read(statistics(5, 1));
  EXPECT_EQ(dropped.count(), 13U);
  dropped.read({});
  EXPECT_EQ(dropped.count(), 13U);
}

/// The reason of the refusal, or "".
std::string refusal(const std::vector<const char*>& words) {
  std::vector<const char*> line{"simulator"};
  line.insert(line.end(), words.begin(), words.end());
  try {
    check_ros_words(static_cast<int>(line.size()), line.data());
  } catch (const RosRefused& refused) {
    EXPECT_EQ(refused.exit_code(), 2);
    EXPECT_EQ(std::string(refused.what()).find('\n'), std::string::npos);
    return refused.what();
  }
  return {};
}

// Each of these ended the program with SIGABRT.
TEST(RosWords, NamesThatRosDoesNotTakeAreRefusedInALine) {
  const char* master = "__master:=http://localhost:11311";
  for (const char* word : {"__ns:=日本", "__ns:=a b", "__ns:=a-b", "__name:=soil-sim", "__name:=1a", "__name:=a/b",
                           "__name:=", "__name:=~a"}) {
    EXPECT_NE(refusal({master, word}).find("a name in ROS has letters, digits and _ only"), std::string::npos) << word;
  }
  for (const char* word : {"__ns:=mpm", "__ns:=/mpm/a_2", "__ns:=/", "__ns:=", "__name:=soil_2"})
    EXPECT_EQ(refusal({master, word}), "") << word;
  EXPECT_NE(refusal({"__master:=localhost"}).find("the master's address"), std::string::npos);
}

}  // namespace neighbours_test
}  // namespace mpm_ros
