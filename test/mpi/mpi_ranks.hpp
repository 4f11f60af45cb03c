// The ranks that the test program was started as.
#pragma once

#include "mpm/ranks/communicator.hpp"

namespace mpm {

Communicator& mpi_ranks();

}  // namespace mpm
