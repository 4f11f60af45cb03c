#include "mpm_ros/node/exit_watchdog.hpp"

#include <cstdlib>
#include <thread>

#include "mpm_ros/run/stop_signals.hpp"

namespace mpm_ros {

ExitWatchdog::ExitWatchdog(std::chrono::milliseconds patience) : patience_(patience) {
  std::thread([this] { watch(); }).detach();
}

void ExitWatchdog::ends(int exit_code) {
  exit_code_ = exit_code;
  ends_ = true;
  may_end_ = true;
}

void ExitWatchdog::watch() const {
  constexpr std::chrono::milliseconds kLook{50}, kStopPatience{900};
  std::chrono::milliseconds stopped{0}, ended{0};
  for (;; std::this_thread::sleep_for(kLook)) {
    stopped = stop_requested() && may_end_ ? stopped + kLook : std::chrono::milliseconds{0};
    ended = ends_ ? ended + kLook : std::chrono::milliseconds{0};
    if (stopped > kStopPatience || ended > patience_) std::_Exit(exit_code_);
  }
}

}  // namespace mpm_ros
