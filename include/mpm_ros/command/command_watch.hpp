// Finds bodies that were commanded and receive no more commands, in simulated time. Motions and wrenches may come from
// different controllers, so they are watched separately.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "mpm/math/state_archive.hpp"
#include "mpm_ros/command/body_command.hpp"

namespace mpm_ros {

struct Silence {
  int body = 0;
  bool wrench = false;  ///< true for wrenches; else for motions
};

class CommandWatch {
 public:
  /// `timeout` [ns]; 0: never.
  explicit CommandWatch(std::int64_t timeout) : timeout_(timeout) {}

  /// Call when a command was applied: the body counts as commanded until the command's effect, or its arrival.
  void heard(const AppliedCommand& command);
  /// Bodies whose last command is the timeout or more ago, by body and motions first. Each silence is returned once.
  std::vector<Silence> silent(std::int64_t now);
  void clear() { heard_.clear(); }
  /// For checkpoints.
  void serialise(mpm::StateArchive& archive);

 private:
  std::int64_t timeout_;
  std::map<std::pair<int, bool>, std::int64_t> heard_;  // [ns] by body, and whether a wrench
};

}  // namespace mpm_ros
