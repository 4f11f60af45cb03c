#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "launcher.hpp"
#include "mpm/simulation/threads.hpp"
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

int end_all(const Communicator& ranks, const std::string& reason, int code) {
  if (dynamic_cast<const PetscCommunicator*>(&ranks) == nullptr) throw RanksEnded(reason, code);
  fail_alike(ranks, reason, code);
  if (ranks.first()) std::fprintf(stderr, "%s\n", reason.c_str());
  return code;
}

void fail_alike(const Communicator& ranks, const std::string& reason, int code) {
  const auto* petsc = dynamic_cast<const PetscCommunicator*>(&ranks);
  constexpr double kGrace = 1.0;  ///< [s] in which ranks that fail alike come together
  if (petsc == nullptr || petsc->all_come(kGrace)) return;
  std::fprintf(stderr, "%s\n", reason.c_str());
  std::fflush(nullptr);
  MPI_Abort(MPI_COMM_WORLD, code);
  std::abort();  // MPI_Abort does not return
}

int threads_of_rank(const Communicator& ranks) {
  const auto* petsc = dynamic_cast<const PetscCommunicator*>(&ranks);
  return petsc == nullptr ? machine_threads() : petsc->threads();
}

Traffic sent(const Communicator& ranks) {
  const auto* petsc = dynamic_cast<const PetscCommunicator*>(&ranks);
  return petsc == nullptr ? Traffic{} : petsc->sent();
}

}  // namespace mpm
