#include "mpm_ros/command/command_watch.hpp"

#include <algorithm>

namespace mpm_ros {

void CommandWatch::heard(const AppliedCommand& command) {
  heard_[{command.body, command.kind == CommandKind::wrench}] = std::max(command.effect, command.arrival);
}

std::vector<Silence> CommandWatch::silent(std::int64_t now) {
  std::vector<Silence> silences;
  if (timeout_ == 0) return silences;
  for (auto entry = heard_.begin(); entry != heard_.end();) {
    if (now - entry->second >= timeout_) {
      silences.push_back({entry->first.first, entry->first.second});
      entry = heard_.erase(entry);
    } else {
      ++entry;
    }
  }
  return silences;
}

void CommandWatch::serialise(mpm::StateArchive& archive) {
  const mpm::StateArchive::Group group(archive, "watch");
  struct Row {
    int body = 0;
    int wrench = 0;
    std::int64_t at = 0;
  };
  std::vector<Row> heard;
  for (const auto& [who, at] : heard_) heard.push_back({who.first, who.second ? 1 : 0, at});
  archive.rows("heard", heard);
  archive.column("heard/body", heard, &Row::body);
  archive.column("heard/wrench", heard, &Row::wrench);
  archive.column("heard/at", heard, &Row::at);
  if (!archive.reading()) return;
  heard_.clear();
  for (const Row& one : heard) heard_[{one.body, one.wrench != 0}] = one.at;
}

}  // namespace mpm_ros
