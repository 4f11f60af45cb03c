#include "mpi_ranks.hpp"

#include <gtest/gtest.h>

#include "mpm_ranks/petsc_communicator.hpp"

namespace mpm {
namespace {

Communicator* made = nullptr;

}  // namespace

Communicator& mpi_ranks() { return *made; }

}  // namespace mpm

int main(int argc, char** argv) {
  mpm::PetscCommunicator ranks;
  mpm::made = &ranks;
  // What goes right is told once.
  if (!ranks.first()) testing::GTEST_FLAG(brief) = true;
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
