#include "launcher.hpp"

#include <algorithm>
#include <cstdlib>

namespace mpm {

int launched_ranks() {
  // Open MPI; MPICH and Intel MPI; MVAPICH; Slurm's srun (a batch script has SLURM_NTASKS, but is one process).
  constexpr const char* kSizes[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE", "SLURM_STEP_NUM_TASKS"};
  int ranks = 1;
  for (const char* name : kSizes) {
    if (const char* value = std::getenv(name)) ranks = std::max(ranks, std::atoi(value));
  }
  return ranks;
}

}  // namespace mpm
