#include "mpm_ros/node/exit_watchdog.hpp"

#include <ros/init.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "mpm_ros/run/stop_signals.hpp"

namespace mpm_ros {

namespace {

/// Ends the process, and before it leaves ROS's graph, as far as the master answers in time.
[[noreturn]] void leave(int exit_code) {
  constexpr std::chrono::milliseconds kPatience{400};
  if (ros::isStarted()) {
    static std::atomic<bool> left{false};
    std::thread([] {
      ros::shutdown();
      left = true;
    }).detach();
    for (std::chrono::milliseconds waited{0}, look{10}; !left && waited < kPatience; waited += look)
      std::this_thread::sleep_for(look);
  }
  std::fflush(stdout);
  std::_Exit(exit_code);
}

}  // namespace

ExitWatchdog::ExitWatchdog(std::chrono::milliseconds patience) : patience_(patience) {
  std::thread([this] { watch(); }).detach();
}

void ExitWatchdog::ends(int exit_code) {
  exit_code_ = exit_code;
  ends_ = true;
  may_end_ = true;
}

void ExitWatchdog::watch() {
  constexpr std::chrono::milliseconds kLook{50};
  std::chrono::milliseconds asked{0}, stopped{0}, ended{0};
  for (;; std::this_thread::sleep_for(kLook)) {
    const bool stop = stop_requested();
    asked = stop ? asked + kLook : std::chrono::milliseconds{0};
    stopped = stop && may_end_ ? stopped + kLook : std::chrono::milliseconds{0};
    ended = ends_ ? ended + kLook : std::chrono::milliseconds{0};
    if (ended > patience_ || (ends_ && stopped > kPatience)) std::_Exit(exit_code_);
    if (stopped > kPatience) {
      const std::string why = used_up();
      std::fprintf(stderr, "stopped before there was a run%s%s\n", why.empty() ? "" : ": ", why.c_str());
      leave(why.empty() ? exit_code_.load() : 1);
    }
    if (!stop) continue;
    // The lock is kept: who works meanwhile waits at the end of its work for the end of the process.
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!close_ || asked <= close_after_) continue;
    try {
      leave(close_());
    } catch (const std::exception& error) {
      std::fprintf(stderr, "the run could not be closed: %s\n", error.what());
      leave(1);
    }
  }
}

ExitWatchdog::Deaf::Deaf(ExitWatchdog& watchdog, std::function<int()> close, std::chrono::milliseconds patience)
    : watchdog_(watchdog) {
  const std::lock_guard<std::mutex> lock(watchdog_.mutex_);
  watchdog_.close_after_ = patience;
  watchdog_.close_ = std::move(close);
}

ExitWatchdog::Deaf::~Deaf() {
  const std::lock_guard<std::mutex> lock(watchdog_.mutex_);
  watchdog_.close_ = nullptr;
}

}  // namespace mpm_ros
