#include "mpm_ros/sweeping/shared_cores.hpp"

#include <unistd.h>

#include <cstdlib>

namespace mpm_ros {

void spin_only_briefly(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr) return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  setenv("GOMP_SPINCOUNT", "500", 0);  // some 20 us, longer than a block of the grid takes
  execv("/proc/self/exe", argv);       // returns only when it cannot: then the threads spin
}

}  // namespace mpm_ros
