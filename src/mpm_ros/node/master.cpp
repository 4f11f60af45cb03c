#include "mpm_ros/node/master.hpp"

#include <fmt/format.h>
#include <ros/console.h>
#include <ros/exceptions.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/names.h>
#include <ros/network.h>

#include <boost/filesystem/exception.hpp>
#include <cstdlib>
#include <exception>
#include <initializer_list>

// In roscpp since its beginning, and exported, but in no header: ros::init() calls it, and may do so again afterwards.
namespace ros::master {
void init(const M_string& remappings);
}

namespace mpm_ros {

namespace {

constexpr int kBadInput = 2, kMachine = 1;

/// Value after "word:=" on the command line; none where it is not given.
std::optional<std::string> word_of(int argc, const char* const* argv, const std::string& word) {
  std::optional<std::string> found;
  for (int i = 1; i < argc; ++i) {
    const std::string given = argv[i];
    if (given.rfind(word + ":=", 0) == 0) found = given.substr(word.size() + 2);
  }
  return found;
}

void check_name(const std::string& where, const std::string& name, const std::string& forbidden) {
  std::string ignored;
  if (!name.empty() && ros::names::validate(name, ignored) && name.find_first_of(forbidden) == std::string::npos)
    return;
  throw RosRefused(
      fmt::format("{} is '{}'; a name in ROS has letters, digits and _ only, and begins with a letter: write "
                  "one such as soil_2",
                  where, name),
      kBadInput);
}

void check_namespace(const std::string& where, const std::string& name) {
  if (name.empty()) return;  // the global one
  check_name(where, name.front() == '/' ? name : "/" + name, "~");
}

}  // namespace

void check_ros_words(int argc, const char* const* argv) {
  if (const auto name = word_of(argc, argv, "__name")) check_name("the node's name, __name,", *name, "/~");
  const char* space = std::getenv("ROS_NAMESPACE");
  if (const auto given = word_of(argc, argv, "__ns")) {
    check_namespace("the namespace, __ns,", *given);
  } else if (space != nullptr) {
    check_namespace("the namespace in the environment, ROS_NAMESPACE,", space);
  }
  const char* environment = std::getenv("ROS_MASTER_URI");
  std::string uri = word_of(argc, argv, "__master").value_or("");
  if (uri.empty() && environment != nullptr) uri = environment;
  std::string host;
  std::uint32_t port = 0;
  if (uri.empty()) {
    throw RosRefused(
        "ROS_MASTER_URI is not set, so no master is known; write: export ROS_MASTER_URI=http://localhost:11311",
        kBadInput);
  }
  if (!ros::network::splitURI(uri, host, port)) {
    throw RosRefused(fmt::format("the master's address, ROS_MASTER_URI or __master, is '{}'; write one such as "
                                 "http://localhost:11311",
                                 uri),
                     kBadInput);
  }
}

bool master_answers(int argc, const char* const* argv) {
  ros::M_string remappings;
  if (const auto master = word_of(argc, argv, "__master")) remappings["__master"] = *master;
  ros::master::init(remappings);
  return ros::master::check();
}

void init_ros(int& argc, char** argv, const std::string& name, std::uint32_t options) {
  try {
    ros::init(argc, argv, name, options);
  } catch (const ros::InvalidNameException& error) {
    throw RosRefused(fmt::format("ROS refuses a name on the command line: {}", error.what()), kBadInput);
  } catch (const boost::filesystem::filesystem_error& error) {
    throw RosRefused(
        fmt::format("ROS cannot make the folder of its logs: {}; set ROS_LOG_DIR, or ROS_HOME, to a folder that can be "
                    "written",
                    error.what()),
        kMachine);
  } catch (const std::exception& error) {
    throw RosRefused(fmt::format("ROS cannot begin: {}; look at the words with := on the command line", error.what()),
                     kBadInput);
  }
}

std::optional<int> begin_ros(int& argc, char** argv, const std::string& name, std::uint32_t options) {
  try {
    check_ros_words(argc, argv);
    if (!master_answers(argc, argv)) {
      throw RosRefused(fmt::format("no master answers at {}; start roscore, or a launch file", ros::master::getURI()),
                       kBadInput);
    }
    init_ros(argc, argv, name, options);
    return std::nullopt;
  } catch (const RosRefused& refused) {
    ROS_FATAL_STREAM(name << ": " << refused.what());
    return refused.exit_code();
  }
}

}  // namespace mpm_ros
