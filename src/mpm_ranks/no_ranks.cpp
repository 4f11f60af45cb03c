// In place of PETSc in a build without MPI: a process is alone, and says so where a launcher thinks otherwise.
#include <fmt/format.h>

#include "launcher.hpp"
#include "mpm/simulation/threads.hpp"
#include "mpm_ranks/make_ranks.hpp"

namespace mpm {

std::shared_ptr<Communicator> make_ranks() {
  if (const int ranks = launched_ranks(); ranks > 1) {
    throw RanksError(fmt::format(
        "started as one of {} ranks, but this build has no MPI: make one that has with scripts/build --mpi, which "
        "installs what it needs, and run its programs, in build_mpi/; or start it without mpirun",
        ranks));
  }
  return nullptr;
}

int end_all(const Communicator&, const std::string& reason, int code) { throw RanksEnded(reason, code); }

void fail_alike(const Communicator&, const std::string&, int) {}

int threads_of_rank(const Communicator&) { return machine_threads(); }

Traffic sent(const Communicator&) { return {}; }

}  // namespace mpm
