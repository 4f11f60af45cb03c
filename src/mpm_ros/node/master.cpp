#include "mpm_ros/node/master.hpp"

#include <ros/master.h>

#include <string>

// In roscpp since its beginning, and exported, but in no header: ros::init() calls it, and may do so again afterwards.
namespace ros::master {
void init(const M_string& remappings);
}

namespace mpm_ros {

bool master_answers(int argc, const char* const* argv) {
  const std::string name = "__master";
  ros::M_string remappings;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.rfind(name + ":=", 0) == 0) remappings[name] = word.substr(name.size() + 2);
  }
  ros::master::init(remappings);
  return ros::master::check();
}

}  // namespace mpm_ros
