#include "mpm_ros/run/stop_signals.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>

namespace mpm_ros {
namespace {

/// [ns] of the steady clock; 0: none has come. Lock-free, so a signal's handler may set it.
std::atomic<std::int64_t> asked_at{0};
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

std::int64_t steady_now() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{1'000'000'000} * now.tv_sec + now.tv_nsec;
}

/// How many NothingToLose there are.
std::atomic<int> nothing_to_lose{0};
static_assert(std::atomic<int>::is_always_lock_free);

void on_stop_signal(int) {
  std::int64_t none = 0;
  asked_at.compare_exchange_strong(none, steady_now());
  if (nothing_to_lose > 0) alarm(1);
}

void on_alarm(int) {
  if (nothing_to_lose <= 0) return;
  constexpr char kLine[] = "stopped while the scene was read; nothing was recorded\n";
  const ssize_t ignored = write(STDERR_FILENO, kLine, sizeof kLine - 1);
  static_cast<void>(ignored);
  _exit(0);
}

}  // namespace

void catch_stop_signals() {
  std::signal(SIGINT, on_stop_signal);
  std::signal(SIGTERM, on_stop_signal);
  if (std::signal(SIGHUP, on_stop_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  std::signal(SIGALRM, on_alarm);
}

bool stop_requested() { return asked_at != 0; }

bool stop_overdue() {
  const std::int64_t at = asked_at;
  return at != 0 && steady_now() - at >= std::chrono::nanoseconds(kStopGrace).count();
}

NothingToLose::NothingToLose() { ++nothing_to_lose; }
NothingToLose::~NothingToLose() { --nothing_to_lose; }

}  // namespace mpm_ros
