// SIGINT, SIGTERM and SIGHUP as a request to end: a run first comes to its next sync point and closes its record. So
// does SIGXCPU, which says that the processor time of the process is used up; and a file that reaches its largest size
// is as a full disk.
#pragma once

#include <chrono>
#include <string>

namespace mpm_ros {

/// From here on these signals ask for an end, and no longer end the process. SIGHUP stays ignored where it is, as under
/// nohup. SIGXFSZ is ignored.
void catch_stop_signals();
/// A write beyond the largest size of files (ulimit -f) fails from here on, as one to a full disk, and no longer ends
/// the process.
void ignore_file_limit();
/// One of them has come.
bool stop_requested();
/// The limit of processor time has come: why the process ends, in one line; else empty.
std::string used_up();
/// It came longer ago than kStopGrace: what has not come to an end by itself since is left as it is.
bool stop_overdue();

inline constexpr std::chrono::milliseconds kStopGrace{400};

}  // namespace mpm_ros
