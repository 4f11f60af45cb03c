#include "mpm/simulation/threads.hpp"

#include <omp.h>

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

}  // namespace mpm
