#include "mpm/simulation/threads.hpp"

#include <omp.h>
#include <sched.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

namespace mpm {
namespace {

constexpr std::uint64_t kParticlesPerThread = 4000;

/// Processors' worth of time that the control group may use; infinite without a limit.
double granted_processors() {
  double quota = 0.0, period = 0.0;
  std::ifstream second("/sys/fs/cgroup/cpu.max");  // "200000 100000", or "max 100000"
  if (!(second >> quota >> period)) {
    std::ifstream("/sys/fs/cgroup/cpu/cpu.cfs_quota_us") >> quota;  // -1: no limit
    std::ifstream("/sys/fs/cgroup/cpu/cpu.cfs_period_us") >> period;
  }
  return quota > 0.0 && period > 0.0 ? quota / period : std::numeric_limits<double>::infinity();
}

}  // namespace

int machine_threads() {
  const int processors = omp_get_max_threads();
  return static_cast<int>(std::clamp(std::ceil(granted_processors()), 1.0, static_cast<double>(processors)));
}

int useful_threads(std::uint64_t particles) {
  return static_cast<int>(
      std::clamp<std::uint64_t>(particles / kParticlesPerThread, 1, static_cast<std::uint64_t>(machine_threads())));
}

ProcessorSet own_processors() {
  ProcessorSet set;
  cpu_set_t allowed;
  static_assert(CPU_SETSIZE == 1024);
  if (sched_getaffinity(0, sizeof(allowed), &allowed) == 0) {
    for (int i = 0; i < CPU_SETSIZE; ++i) set[i] = CPU_ISSET(i, &allowed) != 0;
  } else {  // the machine has more than a set can name
    set.set();
  }
  return set;
}

int threads_beside(const std::vector<ProcessorSet>& all, std::size_t own) {
  constexpr double kRoundOff = 1e-9;
  double share = 0.0;
  for (std::size_t i = 0; i < all[own].size(); ++i) {
    if (!all[own][i]) continue;
    const auto users = std::count_if(all.begin(), all.end(), [i](const ProcessorSet& set) { return set[i]; });
    share += 1.0 / static_cast<double>(users);
  }
  share = std::min(share, std::ceil(granted_processors()) / static_cast<double>(all.size()));
  return static_cast<int>(std::clamp(std::floor(share + kRoundOff), 1.0, static_cast<double>(omp_get_max_threads())));
}

}  // namespace mpm
