#include "launcher.hpp"

#include <algorithm>
#include <cstdlib>

#include "mpm_ranks/make_ranks.hpp"

namespace mpm {
namespace {

// Open MPI; MPICH and Intel MPI; MVAPICH; Slurm's srun (a batch script has SLURM_NTASKS, but is one process).
constexpr const char* kSizes[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE", "SLURM_STEP_NUM_TASKS"};

}  // namespace

void forget_launcher() {
  for (const char* name : kSizes) unsetenv(name);
}

int launched_ranks() {
  int ranks = 1;
  for (const char* name : kSizes) {
    if (const char* value = std::getenv(name)) ranks = std::max(ranks, std::atoi(value));
  }
  return ranks;
}

}  // namespace mpm
