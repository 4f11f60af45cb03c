#include "mpm_ranks/petsc_communicator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <climits>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>
#include <thread>

#include "mpm/simulation/threads.hpp"
#include "petsc_call.hpp"

namespace mpm {
namespace {

/// Parcels travel in pieces of so many bytes: PETSc keeps an index of a few bytes for each.
constexpr std::size_t kPiece = 256;
/// Numbers of all ranks that are gathered at once to be added.
constexpr int kGathered = 1 << 16;
/// [s] in which a rank that waits for the first one hears it at once.
constexpr double kAlert = 0.02;

std::size_t pieces(std::uint64_t bytes) { return (bytes + kPiece - 1) / kPiece; }

/// Notice of a parcel to a rank: its bytes, and the piece of the sender's that it begins with.
struct Notice {
  std::uint64_t bytes, first;
};

}  // namespace

struct PetscCommunicator::State {
  PetscSession session;
  int rank = 0, size = 1, beside = 1, threads = 1;
  Traffic sent;
  std::vector<double> gathered;
  Together piece{static_cast<int>(kPiece), MPI_BYTE};

  State() {
    check_mpi(MPI_Comm_rank(session.all(), &rank));
    check_mpi(MPI_Comm_size(session.all(), &size));
    MPI_Comm machine = MPI_COMM_NULL;
    check_mpi(MPI_Comm_split_type(session.all(), MPI_COMM_TYPE_SHARED, rank, MPI_INFO_NULL, &machine));
    int own = 0;
    check_mpi(MPI_Comm_size(machine, &beside));
    check_mpi(MPI_Comm_rank(machine, &own));
    std::vector<ProcessorSet> all(beside);
    const ProcessorSet allowed = own_processors();
    check_mpi(
        MPI_Allgather(&allowed, sizeof(ProcessorSet), MPI_BYTE, all.data(), sizeof(ProcessorSet), MPI_BYTE, machine));
    threads = threads_beside(all, own);
    check_mpi(MPI_Comm_free(&machine));
  }

  void count_shared(std::uint64_t bytes) {
    ++sent.collectives;
    sent.shared += bytes;
  }
};

namespace {

/// Messages to others, and rows in them, that one broadcast through the forest takes.
struct Load {
  std::uint64_t messages = 0, rows = 0;
};

Load load_of(const StarForest& forest, int self) {
  PetscInt count = 0;
  const PetscMPIInt* ranks = nullptr;
  const PetscInt *offsets = nullptr, *rows = nullptr;
  check(PetscSFGetLeafRanks(forest.get(), &count, &ranks, &offsets, &rows));
  Load load;
  for (PetscInt i = 0; i < count; ++i) {
    if (ranks[i] == self || offsets[i + 1] == offsets[i]) continue;
    ++load.messages;
    load.rows += static_cast<std::uint64_t>(offsets[i + 1] - offsets[i]);
  }
  return load;
}

void check_parcels(const std::vector<Communicator::Parcel>& parcels, int self, int size) {
  std::vector<int> to;
  for (const Communicator::Parcel& parcel : parcels) to.push_back(parcel.rank);
  std::sort(to.begin(), to.end());
  const bool twice = std::adjacent_find(to.begin(), to.end()) != to.end();
  const bool beyond = !to.empty() && (to.front() < 0 || to.back() >= size);
  if (twice || beyond || std::binary_search(to.begin(), to.end(), self)) {
    throw RanksError("ranks: parcels go to other ranks, one to each at most");
  }
}

}  // namespace

class PetscCommunicator::ForestCopies final : public Copies {
 public:
  ForestCopies(std::shared_ptr<State> state, int rows, const std::vector<Source>& sources)
      : state_(std::move(state)), forest_(state_->session.all()) {
    std::vector<PetscSFNode> read;
    read.reserve(sources.size());
    for (const Source& source : sources) read.push_back({source.rank, source.row});
    forest_.set_up(static_cast<std::size_t>(rows), read);
    load_ = load_of(forest_, state_->rank);
  }

  void begin(const double* from, double* to, int numbers) override {
    check(PetscSFBcastBegin(forest_.get(), row(numbers), from, to, MPI_REPLACE));
    state_->sent.messages += load_.messages;
    state_->sent.bytes += load_.rows * static_cast<std::uint64_t>(numbers) * sizeof(double);
  }
  void end(const double* from, double* to, int numbers) override {
    check(PetscSFBcastEnd(forest_.get(), row(numbers), from, to, MPI_REPLACE));
  }

 private:
  /// PETSc keeps its buffers by type, so that of a number of doubles stays the same one.
  MPI_Datatype row(int numbers) { return rows_.try_emplace(numbers, numbers, MPI_DOUBLE).first->second.get(); }

  std::shared_ptr<State> state_;
  std::map<int, Together> rows_;
  StarForest forest_;
  Load load_;
};

PetscCommunicator::PetscCommunicator() : state_(std::make_shared<State>()) {}
PetscCommunicator::~PetscCommunicator() = default;

int PetscCommunicator::rank() const { return state_->rank; }
int PetscCommunicator::size() const { return state_->size; }
const Traffic& PetscCommunicator::sent() const { return state_->sent; }
int PetscCommunicator::on_this_machine() const { return state_->beside; }
int PetscCommunicator::threads() const { return state_->threads; }

bool PetscCommunicator::all_come(double seconds) const {
  MPI_Request request = MPI_REQUEST_NULL;
  check_mpi(MPI_Ibarrier(state_->session.ends(), &request));
  const double until = MPI_Wtime() + seconds;
  int come = 0;
  do {
    check_mpi(MPI_Test(&request, &come, MPI_STATUS_IGNORE));
    if (come != 0) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  } while (MPI_Wtime() < until);
  return false;
}

void PetscCommunicator::sum(double* numbers, int count) {
  const int ranks = state_->size, most = std::max(1, kGathered / ranks);
  for (int first = 0; first < count; first += most) {
    const int part = std::min(most, count - first);
    std::vector<double>& all = state_->gathered;
    all.resize(static_cast<std::size_t>(part) * ranks);
    check_mpi(MPI_Allgather(numbers + first, part, MPI_DOUBLE, all.data(), part, MPI_DOUBLE, state_->session.all()));
    for (int i = 0; i < part; ++i) {
      double total = 0.0;
      for (int rank = 0; rank < ranks; ++rank) total += all[static_cast<std::size_t>(rank) * part + i];
      numbers[first + i] = total;
    }
    state_->count_shared(part * sizeof(double));
  }
}

void PetscCommunicator::largest(double* numbers, int count) {
  // MPI does not say what the largest of numbers is if one of them is not a number: that is asked beside them.
  std::vector<double> both(2 * static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const bool number = !std::isnan(numbers[i]);
    both[2 * i] = number ? numbers[i] : -std::numeric_limits<double>::infinity();
    both[2 * i + 1] = number ? 0.0 : 1.0;
  }
  check_mpi(MPI_Allreduce(MPI_IN_PLACE, both.data(), 2 * count, MPI_DOUBLE, MPI_MAX, state_->session.all()));
  for (int i = 0; i < count; ++i) {
    numbers[i] = both[2 * i + 1] > 0.0 ? std::numeric_limits<double>::quiet_NaN() : both[2 * i];
  }
  state_->count_shared(both.size() * sizeof(double));
}

std::vector<Communicator::Bytes> PetscCommunicator::gather(const Bytes& own) {
  const MPI_Comm all = state_->session.all();
  const std::uint64_t bytes = own.size();
  std::vector<std::uint64_t> sizes(state_->size);
  check_mpi(MPI_Allgather(&bytes, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, all));
  const std::uint64_t total = std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0});
  if (total > INT_MAX) {
    throw RanksError(fmt::format("ranks: {} bytes are too many for all ranks to tell all: at most 2 GiB", total));
  }
  std::vector<int> counts(sizes.begin(), sizes.end()), first(sizes.size());
  std::partial_sum(counts.begin(), counts.end() - 1, first.begin() + 1);
  Bytes received(total);
  check_mpi(MPI_Allgatherv(own.data(), counts[state_->rank], MPI_BYTE, received.data(), counts.data(), first.data(),
                           MPI_BYTE, all));
  state_->count_shared(sizeof(bytes));
  state_->count_shared(bytes);
  std::vector<Bytes> list(sizes.size());
  for (std::size_t rank = 0; rank < list.size(); ++rank) {
    const auto begin = received.begin() + first[rank];
    list[rank].assign(begin, begin + counts[rank]);
  }
  return list;
}

// MPI waits by asking again and again, which takes a processor as long as it lasts.
Communicator::Bytes PetscCommunicator::of_first(const Bytes& own) {
  const MPI_Comm all = state_->session.all();
  std::uint64_t bytes = own.size();
  MPI_Request request = MPI_REQUEST_NULL;
  check_mpi(MPI_Ibcast(&bytes, 1, MPI_UINT64_T, 0, all, &request));
  const double begun = MPI_Wtime();
  for (int come = 0;;) {
    check_mpi(MPI_Test(&request, &come, MPI_STATUS_IGNORE));
    if (come != 0) break;
    if (MPI_Wtime() - begun < kAlert) {
      std::this_thread::yield();
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  if (bytes > INT_MAX) {
    throw RanksError(fmt::format("ranks: {} bytes are too many to tell all ranks: at most 2 GiB", bytes));
  }
  Bytes told = first() ? own : Bytes(bytes);
  check_mpi(MPI_Bcast(told.data(), static_cast<int>(bytes), MPI_BYTE, 0, all));
  state_->count_shared(first() ? sizeof(bytes) + bytes : 0);
  return told;
}

std::vector<Communicator::Parcel> PetscCommunicator::deliver(const std::vector<Parcel>& parcels) {
  check_parcels(parcels, state_->rank, state_->size);
  const MPI_Comm all = state_->session.all();
  std::vector<PetscMPIInt> to;
  std::vector<Notice> notices;
  std::size_t leaving = 0;  // pieces
  for (const Parcel& parcel : parcels) {
    to.push_back(parcel.rank);
    notices.push_back({parcel.bytes.size(), leaving});
    leaving += pieces(parcel.bytes.size());
  }
  PetscMPIInt senders = 0;
  PetscMPIInt* from = nullptr;
  Notice* heard = nullptr;
  check(PetscCommBuildTwoSided(all, 2, MPI_UINT64_T, static_cast<PetscMPIInt>(to.size()), to.data(), notices.data(),
                               &senders, &from, &heard));
  std::vector<std::pair<int, Notice>> coming;
  for (int i = 0; i < senders; ++i) coming.emplace_back(from[i], heard[i]);
  check(PetscFree(from));
  check(PetscFree(heard));
  std::sort(coming.begin(), coming.end(), [](const auto& a, const auto& b) { return a.first < b.first; });

  std::vector<PetscSFNode> read;
  for (const auto& [rank, notice] : coming) {
    const std::size_t end = notice.first + pieces(notice.bytes);
    petsc_index(end);
    for (std::size_t p = notice.first; p < end; ++p) read.push_back({rank, static_cast<PetscInt>(p)});
  }
  StarForest forest(all);
  forest.set_up(leaving, read);
  Bytes out(leaving * kPiece), in(read.size() * kPiece);
  for (std::size_t i = 0; i < parcels.size(); ++i) {
    const Bytes& bytes = parcels[i].bytes;
    std::copy(bytes.begin(), bytes.end(), out.begin() + static_cast<std::ptrdiff_t>(notices[i].first * kPiece));
  }
  check(PetscSFBcastBegin(forest.get(), state_->piece.get(), out.data(), in.data(), MPI_REPLACE));
  check(PetscSFBcastEnd(forest.get(), state_->piece.get(), out.data(), in.data(), MPI_REPLACE));
  const Load load = load_of(forest, state_->rank);
  state_->sent.messages += load.messages + to.size();
  state_->sent.bytes += load.rows * kPiece + to.size() * sizeof(Notice);

  std::vector<Parcel> arrived;
  auto at = in.begin();
  for (const auto& [rank, notice] : coming) {
    arrived.push_back({rank, Bytes(at, at + static_cast<std::ptrdiff_t>(notice.bytes))});
    at += static_cast<std::ptrdiff_t>(pieces(notice.bytes) * kPiece);
  }
  return arrived;
}

void PetscCommunicator::place(const std::vector<double>& own, const std::vector<std::uint64_t>& places, double* to,
                              std::size_t size) {
  std::vector<PetscSFNode> read;
  read.reserve(places.size());
  for (const std::uint64_t place : places) read.push_back({0, petsc_index(place)});
  StarForest forest(state_->session.all());
  forest.set_up(first() ? size : 0, read);
  check(PetscSFReduceBegin(forest.get(), MPI_DOUBLE, own.data(), to, MPI_REPLACE));
  check(PetscSFReduceEnd(forest.get(), MPI_DOUBLE, own.data(), to, MPI_REPLACE));
  if (!first() && !own.empty()) {
    ++state_->sent.messages;
    state_->sent.bytes += own.size() * sizeof(double);
  }
}

std::unique_ptr<Communicator::Copies> PetscCommunicator::make_copies(int rows, const std::vector<Source>& sources) {
  return std::make_unique<ForestCopies>(state_, rows, sources);
}

}  // namespace mpm
