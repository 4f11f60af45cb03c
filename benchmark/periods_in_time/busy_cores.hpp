// Other work on the machine: a process for each core that computes for a part of the time, in pieces of 1 to 10 ms at
// random, as a robot's other nodes do.
#pragma once

#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <random>
#include <thread>
#include <vector>

class BusyCores {
 public:
  /// `part` of each core's time, 0 to 1. To be made before threads are.
  explicit BusyCores(double part) {
    const unsigned cores = part > 0.0 ? std::thread::hardware_concurrency() : 0;
    for (unsigned core = 0; core < cores; ++core) {
      const pid_t child = fork();
      if (child == 0) compute(part, core);
      if (child > 0) children_.push_back(child);
    }
  }
  ~BusyCores() {
    for (const pid_t child : children_) {
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
    }
  }
  BusyCores(const BusyCores&) = delete;
  BusyCores& operator=(const BusyCores&) = delete;

 private:
  /// A piece takes processor time, so the part is kept where others take the core meanwhile.
  [[noreturn]] static void compute(double part, unsigned seed) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const sched_param ordinary{};  // whatever the controller has
    sched_setscheduler(0, SCHED_OTHER, &ordinary);
    setpriority(PRIO_PROCESS, 0, 0);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> length(1e-3, 10e-3);
    for (;;) {
      const double busy = length(random);
      const double until = processor_time() + busy;
      while (processor_time() < until) {
      }
      std::this_thread::sleep_for(std::chrono::duration<double>(busy * (1.0 - part) / part));
    }
  }
  static double processor_time() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  std::vector<pid_t> children_;
};
