#include "mpm_ros/command/command_watch.hpp"

#include <algorithm>
#include <utility>

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

void CommandWatch::keep(mpm::StateArchive& archive) {
  const mpm::StateArchive::Group group(archive, "watch");
  std::vector<std::pair<int, std::int64_t>> heard(heard_.begin(), heard_.end());
  archive.rows("heard", heard);
  archive.column("heard/body", heard, [](auto& one) -> int& { return one.first; });
  archive.column("heard/at", heard, [](auto& one) -> std::int64_t& { return one.second; });
  if (archive.reading()) heard_ = std::map<int, std::int64_t>(heard.begin(), heard.end());
}

}  // namespace mpm_ros
