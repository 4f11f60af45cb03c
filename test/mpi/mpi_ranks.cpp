#include "mpi_ranks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "mpm_ranks/petsc_communicator.hpp"

namespace mpm {
namespace {

Communicator* made = nullptr;

}  // namespace

Communicator& mpi_ranks() { return *made; }

}  // namespace mpm

// mpi_tests end_all: the second rank fails while others wait for it; mpi_tests end_alike: all ranks fail.
int main(int argc, char** argv) {
  mpm::PetscCommunicator ranks;
  mpm::made = &ranks;
  const std::string way = argc > 1 ? argv[1] : "";
  if (way == "end_alike" || (way == "end_all" && ranks.rank() == 1)) {
    return mpm::end_all(ranks, fmt::format("rank {} fails on purpose", ranks.rank()), 3);
  }
  if (way == "end_all") ranks.sum(1.0);
  // Tells once what goes right.
  if (!ranks.first()) testing::GTEST_FLAG(brief) = true;
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
