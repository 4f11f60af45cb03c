#include "mpm_ros/run/shared_cores.hpp"

#include <unistd.h>

#include <cstdlib>

namespace mpm_ros {

void wait_without_spinning(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr) return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  execv("/proc/self/exe", argv);  // returns only when it cannot: then the threads spin
}

}  // namespace mpm_ros
