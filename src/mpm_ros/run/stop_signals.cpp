#include "mpm_ros/run/stop_signals.hpp"

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <string>

namespace mpm_ros {
namespace {

/// [ns] of the steady clock; 0: none has come. Lock-free, so a signal's handler may set it.
std::atomic<std::int64_t> asked_at{0};
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

std::atomic<bool> out_of_time{false};
static_assert(std::atomic<bool>::is_always_lock_free);

std::int64_t steady_now() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{1'000'000'000} * now.tv_sec + now.tv_nsec;
}

void on_stop_signal(int signal) {
  if (signal == SIGXCPU) out_of_time = true;
  std::int64_t none = 0;
  asked_at.compare_exchange_strong(none, steady_now());
}

}  // namespace

void catch_stop_signals() {
  std::signal(SIGINT, on_stop_signal);
  std::signal(SIGTERM, on_stop_signal);
  std::signal(SIGXCPU, on_stop_signal);
  if (std::signal(SIGHUP, on_stop_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  ignore_file_limit();
}

void ignore_file_limit() { std::signal(SIGXFSZ, SIG_IGN); }

std::string used_up() {
  return out_of_time ? "the processor time that the process may take (ulimit -t) is used up: stopped, with what is "
                       "recorded so far; raise the limit"
                     : "";
}

bool stop_requested() { return asked_at != 0; }

bool stop_overdue() {
  const std::int64_t at = asked_at;
  return at != 0 && steady_now() - at >= std::chrono::nanoseconds(kStopGrace).count();
}

}  // namespace mpm_ros
