#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "launcher.hpp"
#include "mpm_ranks/petsc_communicator.hpp"
#include "petsc_call.hpp"

namespace mpm {

std::shared_ptr<Communicator> make_ranks() {
  // MPI takes half a second, and a process beside this one, to find out that there is nobody else.
  const int launched = launched_ranks();
  if (launched == 1) return nullptr;
  auto ranks = std::make_shared<PetscCommunicator>();
  if (ranks->size() != launched) {
    throw RanksError(fmt::format(
        "started as one of {} ranks, of which MPI knows {}: start it with the mpirun of the MPI that it was "
        "built with, or with srun --mpi=pmix",
        launched, ranks->size()));
  }
  return ranks;
}

void end_all(const Communicator& ranks, const std::string& reason, int code) {
  // The first rank ends the others while they wait, if it has something to tell itself.
  if (!ranks.first()) std::this_thread::sleep_for(std::chrono::seconds(1));
  std::fprintf(stderr, "%s\n", reason.c_str());
  std::fflush(nullptr);
  MPI_Abort(MPI_COMM_WORLD, code);
  std::abort();  // MPI_Abort does not return
}

Traffic sent(const Communicator& ranks) {
  const auto* petsc = dynamic_cast<const PetscCommunicator*>(&ranks);
  return petsc == nullptr ? Traffic{} : petsc->sent();
}

}  // namespace mpm
