// Promises of ranks, over MPI: mpirun -n N mpi_tests. Threads are checked for the same in test/unit/ranks_test.cpp.
#include <gtest/gtest.h>

#include <memory>

#include "mpi_ranks.hpp"
#include "mpm_ranks/petsc_communicator.hpp"
#include "ranks_promises.hpp"

namespace mpm {
namespace mpi_ranks_test {

class MpiRanks : public testing::TestWithParam<RanksPromise> {};

TEST_P(MpiRanks, KeepWhatTheyPromise) { GetParam().check(mpi_ranks()); }

INSTANTIATE_TEST_SUITE_P(Of, MpiRanks, testing::ValuesIn(ranks_promises()),
                         [](const auto& promise) { return std::string(promise.param.name); });

TEST(MpiRanks, AreCountedInWhatTheySend) {
  Communicator& ranks = mpi_ranks();
  const int next = (ranks.rank() + 1) % ranks.size();
  const std::uint64_t others = ranks.size() > 1 ? 1 : 0;
  // Every rank has three rows, of which the one before it wants two.
  const auto copies = ranks.make_copies(3, {{next, 2}, {next, 0}});
  const std::vector<double> from(3 * 5, 1.0);
  std::vector<double> to(2 * 5);
  Traffic before = sent(ranks);
  copies->begin(from.data(), to.data(), 5);
  copies->end(from.data(), to.data(), 5);
  EXPECT_EQ(sent(ranks).messages - before.messages, others);
  EXPECT_EQ(sent(ranks).bytes - before.bytes, others * 2 * 5 * sizeof(double));
  EXPECT_EQ(sent(ranks).collectives, before.collectives);
  before = sent(ranks);
  ranks.sum(1.0);
  EXPECT_EQ(sent(ranks).collectives - before.collectives, 1U);
  EXPECT_EQ(sent(ranks).shared - before.shared, sizeof(double));
}

TEST(MpiRanks, RefuseWhatCannotBeSent) {
  Communicator& ranks = mpi_ranks();
  // Each is found by a rank for itself, before anything is sent.
  EXPECT_THROW(ranks.deliver({{ranks.rank(), {}}}), RanksError);
  EXPECT_THROW(ranks.deliver({{ranks.size(), {}}}), RanksError);
  EXPECT_THROW(ranks.place({1.0}, {std::uint64_t{1} << 40}, nullptr, 0), RanksError);
}

TEST(MpiRanks, GiveTheWordsOfPetscForItsErrors) {
  Communicator& ranks = mpi_ranks();
  try {
    ranks.make_copies(1, {{ranks.size() + 3, 0}});  // all ranks find it, before anything is sent
    FAIL() << "a rank that is not there";
  } catch (const RanksError& error) {
    EXPECT_NE(std::string(error.what()).find("PETSc failed with code"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("out of range"), std::string::npos) << error.what();
  }
  EXPECT_EQ(ranks.sum(1.0), ranks.size());
}

}  // namespace mpi_ranks_test
}  // namespace mpm
