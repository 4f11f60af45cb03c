// Notices bodies that were commanded and hear nothing more, in simulated time. Motions and wrenches come from
// controllers of their own: a body that is told both hears of each.
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
  bool wrench = false;  ///< of wrenches; else of motions
};

class CommandWatch {
 public:
  /// `timeout` [ns]; 0: never.
  explicit CommandWatch(std::int64_t timeout) : timeout_(timeout) {}

  /// A command was applied: the body has heard until its effect, or until its arrival.
  void heard(const AppliedCommand& command);
  /// By body, motions first: whose last command is the timeout or more ago. Each silence is told once.
  std::vector<Silence> silent(std::int64_t now);
  void clear() { heard_.clear(); }
  /// For checkpoints.
  void serialise(mpm::StateArchive& archive);

 private:
  std::int64_t timeout_;
  std::map<std::pair<int, bool>, std::int64_t> heard_;  // [ns] by body, and whether a wrench
};

}  // namespace mpm_ros
