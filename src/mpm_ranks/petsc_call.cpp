#include "petsc_call.hpp"

#include <fmt/format.h>

#include <limits>
#include <string>

namespace mpm {
namespace {

/// Error of the last call, where PETSc found it first: it calls the handler in every function on the way out, too.
std::string& last_error() {
  static std::string text;
  return text;
}

PetscErrorCode keep_error(MPI_Comm, int, const char* function, const char*, PetscErrorCode code, PetscErrorType type,
                          const char* message, void*) {
  if (type == PETSC_ERROR_INITIAL) {
    const char* kind = nullptr;
    PetscErrorMessage(code, &kind, nullptr);
    last_error() = fmt::format("{}: {}{}{}", function == nullptr ? "PETSc" : function, kind == nullptr ? "" : kind,
                               kind == nullptr ? "" : ": ", message == nullptr ? "" : message);
  }
  return code;
}

}  // namespace

void check(PetscErrorCode code) {
  if (code == 0) return;
  throw RanksError(fmt::format("ranks: PETSc failed with code {}: {}", static_cast<int>(code), last_error()));
}

void check_mpi(int code) {
  if (code == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING] = "";
  int length = 0;
  MPI_Error_string(code, text, &length);
  throw RanksError(fmt::format("ranks: MPI failed: {}", text));
}

PetscInt petsc_index(std::uint64_t number) {
  constexpr PetscInt kMost = std::numeric_limits<PetscInt>::max();
  if (number > static_cast<std::uint64_t>(kMost)) {
    throw RanksError(
        fmt::format("ranks: {} rows at once are more than the {} that PETSc's indices number here; "
                    "use more ranks",
                    number, kMost));
  }
  return static_cast<PetscInt>(number);
}

PetscSession::PetscSession() {
  int running = 0, level = MPI_THREAD_SINGLE;
  check_mpi(MPI_Initialized(&running));
  if (running == 0) {
    check_mpi(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level));
    own_mpi_ = true;
  } else {
    check_mpi(MPI_Query_thread(&level));
  }
  if (level < MPI_THREAD_FUNNELED) throw RanksError("ranks: this MPI does not allow threads beside those that call it");
  // Neither the program's arguments nor files in its folder are options of PETSc, and signals are the program's.
  static char name[] = "mpm", no_file[] = "-skip_petscrc", no_signals[] = "-no_signal_handler";
  static char* list[] = {name, no_file, no_signals, nullptr};
  int count = 3;
  char** arguments = list;
  check(PetscInitialize(&count, &arguments, nullptr, nullptr));
  check(PetscPushErrorHandler(keep_error, nullptr));
  for (MPI_Comm* ranks : {&all_, &ends_}) {
    check_mpi(MPI_Comm_dup(MPI_COMM_WORLD, ranks));
    check_mpi(MPI_Comm_set_errhandler(*ranks, MPI_ERRORS_RETURN));
  }
}

PetscSession::~PetscSession() {
  MPI_Comm_free(&ends_);
  MPI_Comm_free(&all_);
  PetscFinalize();
  if (own_mpi_) MPI_Finalize();
}

void StarForest::set_up(std::size_t rows, const std::vector<PetscSFNode>& read) {
  // PETSc copies the list, and does not write to it, but has it without const.
  check(PetscSFSetGraph(forest_, petsc_index(rows), petsc_index(read.size()), nullptr, PETSC_COPY_VALUES,
                        const_cast<PetscSFNode*>(read.data()), PETSC_COPY_VALUES));
  check(PetscSFSetUp(forest_));
}

}  // namespace mpm
