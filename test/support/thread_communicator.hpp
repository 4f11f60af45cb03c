// Ranks for tests of a build without MPI: threads of one process, one each. Every call meets those of all ranks, and
// what breaks a promise of the interface (other calls at the same time, a rank that ends early, a parcel to nobody) is
// an error, where MPI would wait for ever.
#pragma once

#include <functional>

#include "mpm/ranks/communicator.hpp"

namespace mpm {

/// Calls `work` on so many ranks at once, and returns when all have ended. Throws what the lowest rank has thrown; the
/// others, which wait for it, are released. @throws RanksError also where ranks call different functions
void run_ranks(int count, const std::function<void(Communicator&)>& work);

}  // namespace mpm
