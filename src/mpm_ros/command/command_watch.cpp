#include "mpm_ros/command/command_watch.hpp"

#include <algorithm>

namespace mpm_ros {

void CommandWatch::heard(const AppliedCommand& command) {
  heard_[command.body] = std::max(command.effect, command.arrival);
}

std::vector<int> CommandWatch::silent(std::int64_t now) {
  std::vector<int> bodies;
  if (timeout_ == 0) return bodies;
  for (auto entry = heard_.begin(); entry != heard_.end();) {
    if (now - entry->second >= timeout_) {
      bodies.push_back(entry->first);
      entry = heard_.erase(entry);
    } else {
      ++entry;
    }
  }
  return bodies;
}

}  // namespace mpm_ros
