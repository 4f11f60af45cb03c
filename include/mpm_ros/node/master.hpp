// The master, and how a program joins its graph: all that roscpp answers with an abort, or by waiting without a limit,
// is looked at before, or caught, and told in one line.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace mpm_ros {

/// ROS cannot begin: why and what to do, in one line.
class RosRefused : public std::runtime_error {
 public:
  RosRefused(const std::string& reason, int exit_code) : std::runtime_error(reason), exit_code_(exit_code) {}
  /// 2: something was given wrong; 1: the machine.
  int exit_code() const { return exit_code_; }

 private:
  int exit_code_;
};

/// Looks at the words and the environment that name the master, the node and its namespace. @throws RosRefused
void check_ros_words(int argc, const char* const* argv);

/// Asks once whether there is a master, at the address that the command line (__master:=) or the environment gives, as
/// ros::init() will; ros::master::getURI() then says which. Asked before ros::init(), since with private parameters on
/// its command line that call writes to the master, and waits for one without a limit. Waits only for a master that
/// takes the call and does not answer.
bool master_answers(int argc, const char* const* argv);

/// ros::init(), which takes its words off the command line. @throws RosRefused
void init_ros(int& argc, char** argv, const std::string& name, std::uint32_t options);

/// All three, for a program that needs a master. The exit code where ROS cannot begin, which has been said then.
std::optional<int> begin_ros(int& argc, char** argv, const std::string& name, std::uint32_t options = 0);

}  // namespace mpm_ros
