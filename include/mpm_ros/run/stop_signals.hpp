// SIGINT, SIGTERM and SIGHUP as a request to end: a run first comes to its next sync point and closes its record.
#pragma once

#include <chrono>

namespace mpm_ros {

/// From here on these signals ask for an end, and no longer end the process. SIGHUP stays ignored where it is, as under
/// nohup.
void catch_stop_signals();
/// One of them has come.
bool stop_requested();
/// It came longer ago than kStopGrace: what has not come to an end by itself since is left as it is.
bool stop_overdue();

/// While one lives the program reads and has nothing to lose: where it does not come to an end by itself within a second
/// of a stop, as in a library that reads a large file, the process ends, with a line that says so and exit code 0.
class NothingToLose {
 public:
  NothingToLose();
  ~NothingToLose();
  NothingToLose(const NothingToLose&) = delete;
  NothingToLose& operator=(const NothingToLose&) = delete;
};

inline constexpr std::chrono::milliseconds kStopGrace{400};

}  // namespace mpm_ros
